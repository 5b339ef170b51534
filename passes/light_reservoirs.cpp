#include "passes/light_reservoirs.hpp"

#include <vector>

#include "framework/base/error.hpp"
#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/reservoir_rows.hpp"

namespace lightloom::passes {
namespace {

std::vector<Port> ports() {
  std::vector<Port> result = reservoir_inputs();
  result.push_back(optional(reservoir_input(
      "past", "reservoirs of a frame ago: connect it to `THIS_PASS.reservoir@1`, or to `reuse_reservoirs`' `@1`")));
  result.push_back(optional(
      same_size_as("surface", surface_input("past_surface", "`surface` a frame ago, by which `past` is found"))));
  result.push_back(optional(
      image_input("moved", Format::rgba32_uint,
                  "moved_voxels.moved; where anything can move, what was a frame ago is not used without it")));
  result.push_back(reservoir_output());
  return result;
}

std::vector<Param> params() {
  return with_share_params({
      integer_param("candidates", 8, 1, 256, "", "points on faces drawn by their power, of which one is chosen"),
      real_param("history", 20, 0, 1000, "frames",
                 "most that earlier frames may count for: more is less noise in a frame, and noise that stays longer"),
      real_param("position_tolerance", 2.0, 0, 100, "pixels",
                 "largest distance between a point and what the last frame saw in its place, in footprints of a pixel "
                 "there"),
      real_param("normal_threshold", 0.9, -1, 1, "", "smallest cosine between the two normals"),
  });
}

void record(PassContext& context) {
  if (context.connected("past") != context.connected("past_surface"))
    throw Error(ExitCode::invalid_input, "light_reservoirs: the inputs 'past' and 'past_surface' need each other",
                "connect both, or neither");
  dispatch_reservoirs(context, "light_reservoirs.comp");
}

}  // namespace

PassType make_light_reservoirs() {
  PassType type;
  type.name = "light_reservoirs";
  type.doc =
      "Chooses for each pixel the point on an emissive face that voxel_path_trace samples at the first hit (input "
      "`reservoir` there): one out of many candidates, in proportion to the light that they reflect, with its share of "
      "multiple importance sampling, as far as nothing is in the way; and with what the pixel had a frame ago as one "
      "more candidate that counts for many (reservoir resampling, Bitterli et al. 2020). The ray to it is the "
      "tracer's, so "
      "that the mean stays what it is without this pass: a sample counts by how likely each of the two could have "
      "held it, which they say of any sample by their own surfaces. That holds for cameras and objects that move; "
      "faces where something moved (input `moved`) begin anew. Not so if a material's emission became 0. Noise of "
      "successive frames is no longer independent.";
  type.ports = ports();
  type.params = params();
  type.reads = FrameState::camera | FrameState::seed | FrameState::lights | FrameState::dynamic_geometry;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
