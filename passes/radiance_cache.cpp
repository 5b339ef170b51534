#include "passes/radiance_cache.hpp"

#include "passes/path_trace_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/voxel_path_trace.hpp"

namespace lightloom::passes {
namespace {

Port past_input() {
  Port port = image_input("past", Format::rgba32_sfloat,
                          "`light` of this pass a frame ago: connect it to `THIS_PASS.light@1`; without, each frame is "
                          "alone and light is scattered once");
  port.bundle = "cached_light";
  port.parts = cached_light_parts();
  port.dimension = Dimension::d3;
  return optional(same_size_as("voxels", port));
}

Port light_output() {
  Port port = bundle_output("cached_light", cached_light_parts(), ExtentRule::like, Access::compute_storage_write,
                            "light that reaches both sides of each voxel, 0 where a voxel is empty");
  port.name = "light";
  port.like = "voxels";
  port.dimension = Dimension::d3;
  port.exact_format = "a mean of many frames stalls in half floats";
  return port;
}

/// One thread for each column of voxels along z.
void record(PassContext& context) {
  require_light_inputs(context);
  const Extent3 grid = context.output_extent("light");
  context.dispatch({"radiance_cache.comp", {grid.width, grid.height, 1}, {{"ward", 2U}, {"ward_sampling", 0U}}});
}

}  // namespace

std::vector<PortPart> cached_light_parts() {
  return {{"front", Format::rgba32_sfloat,
           "rgb: radiance that a white matt surface would scatter on the side of the voxel's normal [W m^-2 sr^-1]; a: "
           "frames in the mean, 0: nothing is known"},
          {"back", Format::rgba32_sfloat, "the same on the other side"}};
}

PassType make_radiance_cache() {
  PassType type;
  type.name = "radiance_cache";
  type.doc =
      "Light that reaches each side of each occupied voxel: one sample a side and frame, of the light sources and of "
      "what one scattered ray meets, with the light that was cached there a frame ago; the mean over frames. So light "
      "is "
      "scattered any number of times, once more in each frame. A path that ends at such a voxel (param `cache_from` of "
      "voxel_path_trace) has less noise and fewer rays, but blurs light over a voxel, takes every surface for matt, "
      "and "
      "lags where something moves.";
  type.ports = light_inputs();
  type.ports.push_back(past_input());
  type.ports.push_back(light_output());
  type.params = march_params();
  type.params.push_back(
      integer_param("frames", 256, 1, 65535, "", "the mean forgets what is older than so many frames, gradually"));
  const std::vector<Param> light = with_path_params({});
  for (const Param& param : light)
    if (param.name != "paths" && param.name != "bounces" && param.name != "regularization" && param.name != "ward" &&
        param.name != "ward_sampling")
      type.params.push_back(param);
  type.reads = FrameState::camera | FrameState::seed | FrameState::lights | FrameState::time;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
