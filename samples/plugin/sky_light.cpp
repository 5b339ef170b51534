// A GI pass of one's own: light of the sky and the sun that reaches a surface straight, nothing that bounces. It has
// the outputs of voxel_path_trace, so it takes its place in any graph: --swap trace=sky_light_trace
#include <framework/graph/plugin.hpp>
#include <passes/param_rows.hpp>
#include <passes/port_rows.hpp>

namespace {

using namespace lightloom;
using namespace lightloom::passes;

PassType make_sky_light_trace() {
  PassType type;
  type.name = "sky_light_trace";
  type.doc = "Light of the sky and the sun that reaches each surface straight through the voxel grid, without bounces.";
  // A GI pass gives each lobe's light apart as well. This one knows no glossy reflections.
  const auto light = [](const std::string& name, const std::string& doc) {
    return bypassed_by(ClearColor{0, 0, 0, 0}, image_output_like(name, Format::rgba32_sfloat, "surface", doc));
  };
  type.ports = {surface_input("surface", "first hits"),
                volume_input("distance", "chessboard distance to the nearest occupied voxel [voxels / 255], capped"),
                light("radiance", "rgb: light that a white surface would reflect [W m^-2 sr^-1]; a: 1 where lit"),
                light("diffuse", "the same"), light("specular", "black")};
  // Of the same name and kind as those of voxel_path_trace, so that a swap keeps what a graph sets. The latter two are
  // specialization constants of the shader's library.
  type.params = {integer_param("paths", 1, 1, 256, "", "rays to the sky per pixel and frame"),
                 choice_param("march", "cube_exit", {"sphere", "cube_exit", "dda"},
                              "how rays go through the grid, see voxel_path_trace"),
                 choice_param("start", "clearance", {"clearance", "sqrt3"}, "where rays start, see voxel_path_trace")};
  type.reads = FrameState::seed | FrameState::camera | FrameState::lights;
  type.record = one_dispatch("sky_light_trace.comp", "radiance");
  return type;
}

}  // namespace

LIGHTLOOM_PLUGIN("sky_light", "1.0", make_sky_light_trace())
