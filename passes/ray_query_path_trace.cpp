#include "passes/ray_query_path_trace.hpp"

#include "passes/path_trace_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_ray_query_path_trace() {
  PassType type;
  type.name = "ray_query_path_trace";
  type.doc =
      "Global illumination by paths that start at the G-buffer and go on among the scene's triangles, for devices with "
      "ray queries (VK_KHR_ray_query). The same light, lobes and sampling as `voxel_path_trace`, whose place it can "
      "take, so that the two differ by the voxels alone. Rays meet both sides of every triangle; a material that is "
      "not double sided emits from its front. Textures are read at their finest level.";
  type.ports = with_light_outputs({surface_input("surface", "first hits; one path tree starts at each pixel")});
  type.params = with_path_params({});
  type.reads = FrameState::camera | FrameState::seed | FrameState::lights | FrameState::materials |
               FrameState::static_geometry | FrameState::dynamic_geometry;
  type.needs.ray_query = true;
  type.record = one_dispatch("ray_query_path_trace.comp", "radiance");
  return type;
}

}  // namespace lightloom::passes
