#include "passes/reuse_reservoirs.hpp"

#include <vector>

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/reservoir_rows.hpp"

namespace lightloom::passes {
namespace {

constexpr int kMostNeighbours = 8;  // as in shaders/reuse_reservoirs.comp

std::vector<Port> ports() {
  std::vector<Port> result = reservoir_inputs();
  result.push_back(reservoir_input("reservoir", "of light_reservoirs, or of another pass of this type"));
  Port output = reservoir_output();
  output.bypass = Bypass{"reservoir", {}};
  result.push_back(output);
  return result;
}

std::vector<Param> params() {
  return with_share_params({
      integer_param("neighbours", 3, 0, kMostNeighbours, "", "pixels whose reservoirs are looked at"),
      real_param("radius", 12, 0, 1000, "pixels", "of the disc that they are drawn from"),
      real_param("depth_tolerance", 0.02, 0, {}, "",
                 "largest distance of their surfaces from the plane of the pixel's, in parts of its view depth"),
      real_param("normal_threshold", 0.9, -1, 1, "", "smallest cosine between their normals and the pixel's"),
      integer_param("sequence", 0, 0, 255, "",
                    "of random numbers: passes of this type that read each other must have different ones"),
  });
}

}  // namespace

PassType make_reuse_reservoirs() {
  PassType type;
  type.name = "reuse_reservoirs";
  type.doc =
      "Chooses for each pixel among its own light sample and those of a few pixels around it. A sample counts by how "
      "likely each of these pixels could have held it, so that the mean stays what it is; thresholds decide about "
      "noise alone.";
  type.ports = ports();
  type.params = params();
  type.reads = FrameState::camera | FrameState::seed | FrameState::lights;
  type.record = [](PassContext& context) { dispatch_reservoirs(context, "reuse_reservoirs.comp"); };
  return type;
}

}  // namespace lightloom::passes
