// A GI pass of one's own: light of the sky and the sun that reaches a surface straight, nothing that bounces. It has
// the outputs of voxel_path_trace, so it takes its place in any graph: --swap trace=sky_light_trace
#include <framework/graph/plugin.hpp>
#include <passes/port_rows.hpp>

namespace {

using namespace lightloom;

PassType make_sky_light_trace() {
  PassType type;
  type.name = "sky_light_trace";
  type.doc = "Light of the sky and the sun that reaches each surface straight through the voxel grid, without bounces.";
  type.ports = {
      passes::surface_input("surface", "first hits"),
      passes::volume_input("distance", "chessboard distance to the nearest occupied voxel [voxels / 255], capped"),
      passes::image_output_like("radiance", Format::rgba32_sfloat, "surface",
                                "rgb: light that a white surface would reflect [W m^-2 sr^-1]; a: 1 where lit")};
  // A GI pass gives each lobe's light apart as well. This one knows no glossy reflections.
  type.ports.push_back(passes::image_output_like("diffuse", Format::rgba32_sfloat, "surface", "the same"));
  type.ports.push_back(passes::image_output_like("specular", Format::rgba32_sfloat, "surface", "black"));
  for (Port& port : type.ports)
    if (port.direction == Direction::out) port.bypass = Bypass{};
  // Of the same name and kind as those of voxel_path_trace, so that a swap keeps what a graph sets. The latter two are
  // specialization constants of the shader's library.
  type.params = {{"paths", ParamType::integer, int64_t{1}, 1, 256, {}, "", "rays to the sky per pixel and frame"},
                 {"march",
                  ParamType::choice,
                  std::string("cube_exit"),
                  {},
                  {},
                  {"sphere", "cube_exit", "dda"},
                  "",
                  "how rays go through the grid, see voxel_path_trace"},
                 {"start",
                  ParamType::choice,
                  std::string("clearance"),
                  {},
                  {},
                  {"clearance", "sqrt3"},
                  "",
                  "where rays start, see voxel_path_trace"}};
  type.reads = FrameState::seed | FrameState::camera | FrameState::lights;
  type.record = [](PassContext& context) {
    context.dispatch({"sky_light_trace.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const lightloom::Plugin lightloom_plugin{
    lightloom::plugin_interface(), LIGHTLOOM_VERSION, "sky_light", "1.0",
    [](lightloom::PassRegistry& registry) { registry.add(make_sky_light_trace()); }};
