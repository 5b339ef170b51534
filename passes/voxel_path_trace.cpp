#include "passes/voxel_path_trace.hpp"

#include "framework/base/error.hpp"
#include "passes/empty_boxes.hpp"
#include "passes/path_trace_rows.hpp"
#include "passes/port_rows.hpp"
#include "passes/radiance_cache.hpp"
#include "passes/reservoir_rows.hpp"

namespace lightloom::passes {

namespace {

Port optional_image(std::string name, Format format, std::string doc) {
  Port port = image_input(std::move(name), format, std::move(doc));
  port.optional = true;
  return port;
}

Port boxes_input() {
  Port port = many_times(kBoxBlocks,
                         same_size_as("distance", optional_image("boxes", Format::r32_uint,
                                                                 "empty_boxes.boxes; what `march` box_exit steps by")));
  port.dimension = Dimension::d3;
  port.needed_with = [](const ParamSet& params) { return params.choice("march") == "box_exit"; };
  return port;
}

/// What the pass did, for who measures it.
Port counts_output() {
  Port port = image_output_like("counts", Format::rg32_uint, "surface",
                                "r: rays that were marched through the grid for all paths of the pixel, those to "
                                "lights included; g: distances that they read, one a step. Costs nothing unless "
                                "something reads it");
  port.bypass = Bypass{};
  return port;
}

Port cache_input() {
  Port port = cached_light_input("cache", "radiance_cache.light; what `cache_from` ends paths by");
  port.needed_with = [](const ParamSet& params) { return params.integer("cache_from") > 0; };
  return port;
}

Port held_sample_input() {
  Port port = reservoir_input("reservoir",
                              "light_reservoirs.reservoir or reuse_reservoirs.reservoir, with `nee` voxel_faces: the "
                              "light sample of emissive faces at the first hit, one ray for all paths of the pixel; "
                              "paths draw none of their own there. What `reservoir_draws` asks for");
  port.needed_with = [](const ParamSet& params) { return params.real("reservoir_draws") > 0; };
  return optional(port);
}

std::vector<Port> ports() {
  std::vector<Port> inputs{surface_input("surface", "first hits; one path tree starts at each pixel")};
  const std::vector<Port> light = light_inputs();
  inputs.insert(inputs.end(), light.begin(), light.end());
  inputs.push_back(cache_input());
  inputs.push_back(held_sample_input());
  std::vector<Port> result = with_light_outputs(inputs);
  result.push_back(counts_output());
  return result;
}

std::vector<Param> params() {
  std::vector<Param> own = voxel_path_params();
  own.push_back(integer_param("cache_from", 0, 0, 64, "",
                              "from this vertex after the first hit on, a path ends at the first voxel of which input "
                              "`cache` knows the light; 0: never"));
  own.push_back(real_param(
      "reservoir_draws", 0, 0, 1e6, "",
      "draws of a light that the sample in input `reservoir` counts for at the first hit, beside one scattered ray, in "
      "multiple importance sampling: more leaves less of the light to what rays meet by chance; 0: there is no such "
      "sample, and paths draw their own"));
  return with_path_params(own);
}

void require_input(const PassContext& context, const std::string& param, const std::string& value,
                   const std::string& port) {
  if (context.params().choice(param) != value || context.connected(port)) return;
  throw Error(
      ExitCode::invalid_input,
      "voxel_path_trace: param '" + param + "' is '" + value + "', but the input '" + port + "' is not connected",
      "connect it to an emissive_faces pass: \"" + port + "\": \"emissive_faces." + port + "\"");
}

}  // namespace

std::vector<Port> light_inputs() {
  return {voxels_input("voxels", "what the paths meet after the first hit"),
          same_size_as("voxels", volume_input("distance",
                                              "chessboard distance to the nearest occupied voxel [voxels / 255], "
                                              "capped")),
          boxes_input(),
          optional_image("faces", Format::rg32_uint, "emissive_faces.faces; what `nee` voxel_faces draws from"),
          optional_image("power", Format::r32_uint, "emissive_faces.power; what `emitter_area` surface compares with")};
}

std::vector<Param> voxel_path_params() {
  return {
      choice_param(
          "march", "cube_exit", {"sphere", "cube_exit", "dda", "box_exit"},
          "how rays go through the grid: by steps as long as the distance to the nearest occupied voxel (sphere, the "
          "paper's, which steps over corners); to the end of the empty cube around them (cube_exit), from voxel to "
          "voxel (dda) or to the end of the empty box ahead of them, from input `boxes` (box_exit; cube_exit where "
          "that "
          "is not there), which all three find every voxel that a ray touches"),
      choice_param(
          "start", "clearance", {"clearance", "sqrt3"},
          "where the rays of a surface start: as far along its normal as it takes to leave the voxels of its plane, "
          "|x| + |y| + |z| voxels, one and a half times that from the middle of a voxel (clearance), or sqrt(3) "
          "voxels from where the surface was hit (sqrt3, the paper's author's)"),
      choice_param(
          "nee", "hints", {"hints", "voxel_faces"},
          "next event estimation towards emissive surfaces: by points on their triangles (hints, the paper's), which "
          "are a little less than the voxels that scattered rays meet, so that the light depends on who finds it; or "
          "by the very faces that rays meet, from input `faces`, with the same density on both sides"),
      choice_param(
          "emitter_area", "voxels", {"voxels", "surface"},
          "radiance of emissive voxels: the material's, so that a lamp narrower than a voxel is too bright; or "
          "scaled, by input `power`, so that all voxels of an emission have the power of its triangles, at most by 4"),
      integer_param(
          "roulette", 0, 0, 64, "",
          "Russian roulette: from this vertex after the first hit on, a path goes on with the probability of the "
          "brightest channel of what it still carries, at least 1/20, and carries more by as much: fewer rays, more "
          "noise, the same mean; 0: never")};
}

void require_light_inputs(const PassContext& context) {
  require_input(context, "nee", "voxel_faces", "faces");
  require_input(context, "emitter_area", "surface", "power");
}

PassType make_voxel_path_trace() {
  PassType type;
  type.name = "voxel_path_trace";
  type.doc =
      "Global illumination by paths that start at the G-buffer and go on through the voxel grid. Next event "
      "estimation towards light hints, the sun and punctual lights, combined with Ward importance sampling by "
      "multiple importance sampling; rays march through the distance field (paper, section 2.2).";
  type.ports = ports();
  type.params = params();
  type.reads = FrameState::camera | FrameState::seed | FrameState::lights;
  type.record = [](PassContext& context) {
    require_light_inputs(context);
    if (context.params().real("reservoir_draws") > 0 && context.params().choice("nee") != "voxel_faces")
      throw Error(ExitCode::invalid_input,
                  "voxel_path_trace: what 'reservoir_draws' asks for, input 'reservoir', are points on faces of voxels",
                  "set the param 'nee' to 'voxel_faces', or 'reservoir_draws' to 0");
    context.dispatch({"voxel_path_trace.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
