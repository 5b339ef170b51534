// Paths from the G-buffer through the voxel grid. See passes/voxel_path_trace.cpp for the ports and params.
//
// Vertex 0 is the first hit, vertices 1 to `bounces` are voxels. Every vertex gathers direct light; the ray that leaves
// it adds its share of what it meets: an emissive voxel, the sun's disc or the environment. So light that was scattered
// 1 to bounces + 1 times is counted, from every kind of source.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/features.glsl"
#include "lib/first_hit.glsl"
#include "lib/lights.glsl"
#include "lib/ray_start.glsl"
#include "lib/traced_light.glsl"
#include "lib/voxel_vertex.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
uniform texture3D distance;
uniform texture3D cache_front;
uniform texture3D cache_back;
uniform writeonly uimage2D out_counts;

layout(push_constant) uniform Params {
  uint paths;
  uint bounces;
  float regularization;
  uint roulette;
};

layout(constant_id = 3) const bool counts_wanted = false;
layout(constant_id = 33) const bool cache_bound = false;
layout(constant_id = 34) const uint cache_from = 0u;

const float kLeastSurvival = 0.05;   // a path that carries next to nothing still ends within a few vertices

// Is there light that the last ray of a path could meet?
const bool kRaysFindLight = has_emissive || has_environment || has_sun;

PathVertex surface_vertex(Grid grid, ivec2 pixel) {
  PathVertex vertex = first_hit(pixel);
  vec3 normal = vertex.geometric_normal;
  vertex.origin = world_to_grid(grid, vertex.position) + normal * start_offset(normal);
  return vertex;
}

// Does a path that carries `throughput` from vertex `bounce` on go further? If so it carries more by as much as this was
// unlikely. `u`: a uniform number.
bool survives(uint bounce, float u, inout vec3 throughput) {
  if (roulette == 0u || bounce < roulette) return true;
  float chance = clamp(max(throughput.r, max(throughput.g, throughput.b)), kLeastSurvival, 1.0);
  throughput /= chance;
  return u < chance;
}

// From a vertex on that the graph chooses, adds what the cache knows of all light that the voxel scatters; false if it knows
// nothing yet.
bool cached(MarchHit hit, VoxelSurface surface, vec3 direction, PathVertex vertex, uint bounce, vec3 throughput,
            inout vec3 radiance) {
  if (!cache_bound || cache_from == 0u || bounce < cache_from) return false;
  vec4 light = meets_front(surface, direction) ? texelFetch(cache_front, hit.voxel, 0)
                                               : texelFetch(cache_back, hit.voxel, 0);
  if (light.a <= 0.0) return false;
  radiance += throughput * albedo_towards(vertex) * light.rgb;
  return true;
}

// Light that arrives at vertex 0 along the scattered ray.
vec3 trace_incoming(Grid grid, PathVertex vertex, BsdfSample scatter, RandomKey key) {
  vec3 radiance = vec3(0.0);
  vec3 throughput = vec3(1.0);
  float least_alpha = kVoxelMinimumAlpha;
  for (uint bounce = 1u;; ++bounce) {
    vec3 direction = to_world(vertex.basis, scatter.direction);
    if (dot(direction, vertex.geometric_normal) <= 0.0) break;
    MarchHit hit = march_grid(distance, vertex.origin, direction, kFarAway);
    if (!hit.hit) {
      radiance += throughput * (environment_hit(direction, scatter) + sun_hit(direction, scatter));
      break;
    }
    VoxelSurface surface = surface_of(voxels_albedo, voxels_normal, voxels_material, hit.voxel);
    vec3 from = vertex.position;
    vec3 origin = vertex.origin;
    least_alpha = max(least_alpha, min(scatter.roughness, regularization));
    vertex = voxel_vertex(grid, hit, origin, direction, surface, least_alpha);
    radiance += throughput * emitter_hit(grid, voxels_albedo, hit, surface, from, vertex.position, origin, direction,
                                         scatter);
    if (bounce > bounces) break;
    if (cached(hit, surface, direction, vertex, bounce, throughput, radiance)) break;
    PerLobe direct = direct_light(grid, distance, voxels_normal, voxels_material, vertex, key, bounce);
    radiance += throughput * (direct.diffuse + direct.specular);
    if (bounce == bounces && !kRaysFindLight) break;
    vec4 u = path_random4(key, bounce, kDimensionScatter);
    scatter = bsdf_sample(vertex.bsdf, vertex.incoming, u.xyz);
    throughput *= scatter.weight;
    if (throughput == vec3(0.0) || !survives(bounce, u.w, throughput)) break;
  }
  return radiance;
}

// Light that each lobe of the first hit scatters to the viewer.
PerLobe trace_path(Grid grid, PathVertex first, RandomKey key) {
  PerLobe light = direct_light(grid, distance, voxels_normal, voxels_material, first, key, 0u);
  if (bounces == 0u && !kRaysFindLight) return light;
  BsdfSample scatter = bsdf_sample(first.bsdf, first.incoming, path_random4(key, 0u, kDimensionScatter).xyz);
  if (scatter.weight == vec3(0.0)) return light;
  vec3 incoming = trace_incoming(grid, first, scatter, key);
  light.diffuse += max(scatter.weight - scatter.specular_weight, vec3(0.0)) * incoming;
  light.specular += scatter.specular_weight * incoming;
  return light;
}

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  bool lit = is_lit(pixel);
  TracedLight sum = kNothingTraced;
  if (lit) {
    Grid grid = scene_grid(textureSize(distance, 0));
    PathVertex first = surface_vertex(grid, pixel);
    RandomKey key = RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, paths);
    for (key.path = 0u; key.path < paths; ++key.path) add_path(sum, first, trace_path(grid, first, key));
  }
  store_light(pixel, sum, paths, lit);
  if (counts_wanted) imageStore(out_counts, pixel, uvec4(rays_marched, steps_marched, 0u, 0u));
}
