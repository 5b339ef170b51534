// Paths through the voxel grid.
//
// Vertex 0 is given, vertices 1 to `bounces` are voxels. Every vertex gathers direct light; the ray that leaves it adds its
// share of what it meets: an emissive voxel, the sun's disc or the environment. So light that was scattered 1 to
// bounces + 1 times is counted, from every kind of source.
#ifndef LIGHTLOOM_LIB_VOXEL_PATH
#define LIGHTLOOM_LIB_VOXEL_PATH

#include "lib/cached_light.glsl"
#include "lib/features.glsl"
#include "lib/lights.glsl"
#include "lib/voxel_vertex.glsl"
#include "lib/voxels.glsl"

uniform texture3D distance;

// How far paths go: see the params of the passes that trace them.
struct PathLimits {
  uint bounces;
  float regularization;
  uint roulette;
  uint cache_from;
  float reservoir_draws;   // of emissive faces, made for vertex 0 by a reservoir; 0: none, it draws its own
};

const float kLeastCached = 2.0;      // [voxels] light that comes from nearer would be seen in blocks
const float kLeastSurvival = 0.05;   // a path that carries next to nothing still ends within a few vertices

// Is there light that the last ray of a path could meet?
const bool kRaysFindLight = has_emissive || has_environment || has_sun;

// Does a path that carries `throughput` from vertex `bounce` on go further? If so it carries more by as much as this was
// unlikely. `u`: a uniform number.
bool survives(uint roulette, uint bounce, float u, inout vec3 throughput) {
  if (roulette == 0u || bounce < roulette) return true;
  float chance = clamp(max(throughput.r, max(throughput.g, throughput.b)), kLeastSurvival, 1.0);
  throughput /= chance;
  return u < chance;
}

// Adds what the cache knows of all light that the voxel scatters; false if it knows nothing. It knows the side of the
// voxel's normal: the other may be the outside of a room whose other wall the ray has met.
bool cached(MarchHit hit, VoxelSurface surface, vec3 direction, PathVertex vertex, vec3 throughput, inout vec3 radiance) {
  if (!meets_front(surface, direction) || hit.t < kLeastCached) return false;
  vec4 light = texelFetch(cache, hit.voxel, 0);
  if (!(light.a > 0.0)) return false;
  radiance += throughput * albedo_towards(vertex) * light.rgb;
  return true;
}

// Draws of emissive faces at a vertex.
float draws_at(uint bounce, PathLimits limits) {
  return bounce == 0u && limits.reservoir_draws > 0.0 ? limits.reservoir_draws : 1.0;
}

// Light that arrives at vertex 0 along the scattered ray.
vec3 trace_incoming(Grid grid, PathVertex vertex, BsdfSample scatter, RandomKey key, PathLimits limits) {
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
    least_alpha = max(least_alpha, min(scatter.roughness, limits.regularization));
    vertex = voxel_vertex(grid, hit, origin, direction, surface, least_alpha);
    radiance += throughput * emitter_hit(grid, voxels_albedo, hit, surface, from, vertex.position, origin, direction,
                                         scatter, draws_at(bounce - 1u, limits));
    if (bounce > limits.bounces) break;
    bool may_end = cache_bound && limits.cache_from > 0u && bounce >= limits.cache_from;
    if (may_end && cached(hit, surface, direction, vertex, throughput, radiance)) break;
    PerLobe direct = direct_light(grid, distance, voxels_normal, voxels_material, vertex, key, bounce, true);
    radiance += throughput * (direct.diffuse + direct.specular);
    if (bounce == limits.bounces && !kRaysFindLight) break;
    vec4 u = path_random4(key, bounce, kDimensionScatter);
    scatter = bsdf_sample(vertex.bsdf, vertex.incoming, u.xyz);
    throughput *= scatter.weight;
    if (throughput == vec3(0.0) || !survives(limits.roulette, bounce, u.w, throughput)) break;
  }
  return radiance;
}

// Light that each lobe of the first hit scatters to the viewer; of what a reservoir stands for, what rays find by chance.
PerLobe trace_path(Grid grid, PathVertex first, RandomKey key, PathLimits limits) {
  PerLobe light = direct_light(grid, distance, voxels_normal, voxels_material, first, key, 0u,
                               limits.reservoir_draws == 0.0);
  if (limits.bounces == 0u && !kRaysFindLight) return light;
  BsdfSample scatter = bsdf_sample(first.bsdf, first.incoming, path_random4(key, 0u, kDimensionScatter).xyz);
  if (scatter.weight == vec3(0.0)) return light;
  vec3 incoming = trace_incoming(grid, first, scatter, key, limits);
  light.diffuse += max(scatter.weight - scatter.specular_weight, vec3(0.0)) * incoming;
  light.specular += scatter.specular_weight * incoming;
  return light;
}

#endif
