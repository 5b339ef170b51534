// Paths from the G-buffer through the voxel grid. See passes/voxel_path_trace.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Params {
  uint paths;
  uint bounces;
  float regularization;
  uint roulette;
  uint cache_from;
  float reservoir_draws;
};

#include "lib/first_hit.glsl"
#include "lib/reservoir_light.glsl"
#include "lib/surface_vertex.glsl"
#include "lib/traced_light.glsl"
#include "lib/voxel_path.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly uimage2D out_counts;

layout(constant_id = 3) const bool counts_wanted = false;

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  bool lit = is_lit(pixel);
  TracedLight sum = kNothingTraced;
  if (lit) {
    Grid grid = scene_grid(textureSize(distance, 0));
    PathVertex first = among_voxels(grid, first_hit(pixel));
    PerLobe sampled;   // once for all paths
    bool resampled = reservoir_light(grid, distance, first, pixel, sampled);
    if (resampled) add_path(sum, first, scaled(sampled, vec3(paths)));
    PathLimits limits =
        PathLimits(bounces, regularization, roulette, cache_from, resampled ? reservoir_draws : 0.0);
    RandomKey key = RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, paths);
    for (key.path = 0u; key.path < paths; ++key.path) add_path(sum, first, trace_path(grid, first, key, limits));
  }
  store_light(pixel, sum, paths, lit);
  if (counts_wanted) imageStore(out_counts, pixel, uvec4(rays_marched, steps_marched, 0u, 0u));
}
