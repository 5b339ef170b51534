#include "passes/radiance_cache.hpp"

#include <cstdint>
#include <utility>

#include "passes/path_trace_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/voxel_path_trace.hpp"

namespace lightloom::passes {
namespace {

Port past_input() {
  return cached_light_input("cache",
                            "`light` of this pass a frame ago: connect it to `THIS_PASS.light@1`; without, each frame "
                            "stands alone, of whole paths");
}

Port light_output() {
  Port port =
      image_output_like("light", Format::rgba32_sfloat, "voxels",
                        "rgb: radiance that a white matt surface would scatter there, on the side of the voxel's "
                        "normal [W m^-2 sr^-1]; a: samples in the mean, 0 where nothing is known");
  port.dimension = Dimension::d3;
  port.exact_format = "a mean of many samples stalls in half floats";
  return port;
}

// The first of the choices of the tracers' param. A sequence over pixels means nothing among voxels.
constexpr std::uint32_t kSamplingIndependent = 0;

std::vector<Param> params() {
  std::vector<Param> result = with_path_params(voxel_path_params());
  std::erase_if(result, [](const Param& param) { return param.name == "paths" || param.name == "sampling"; });
  result.push_back(
      integer_param("frames", 256, 1, 65535, "", "the mean forgets what is older than so many samples, gradually"));
  result.push_back(integer_param("interval", 1, 1, 256, "",
                                 "one of so many voxels is sampled in a frame, in turn; those of which nothing is "
                                 "known yet, at once"));
  return result;
}

/// One thread for each voxel, then one for each column of them along z.
void record(PassContext& context) {
  require_light_inputs(context);
  const Extent3 grid = context.output_extent("light");
  context.dispatch({"radiance_cache_keep.comp", grid, {}});
  context.dispatch({"radiance_cache.comp", {grid.width, grid.height, 1}, {{"sampling", kSamplingIndependent}}});
}

}  // namespace

Port cached_light_input(std::string name, const std::string& doc) {
  Port port = image_input(std::move(name), Format::rgba32_sfloat, doc);
  port.dimension = Dimension::d3;
  return optional(same_size_as("voxels", port));
}

PassType make_radiance_cache() {
  PassType type;
  type.name = "radiance_cache";
  type.doc =
      "Light that reaches each side of each occupied voxel: the mean over frames of one path a side and frame, which "
      "ends "
      "at the first voxel whose light was known a frame ago. So light is scattered any number of times, with about two "
      "rays a path. A path that ends at such a voxel (param `cache_from` of voxel_path_trace) has less noise and fewer "
      "rays, but blurs light over a voxel, takes the surface there for matt, and lags where something moves. Paths "
      "that meet the other side of a voxel go on.";
  type.ports = light_inputs();
  type.ports.push_back(past_input());
  type.ports.push_back(light_output());
  type.params = params();
  type.reads = FrameState::seed | FrameState::lights;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
