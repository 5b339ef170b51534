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
#include "lib/voxel_bits.glsl"
#include "lib/voxel_encoding.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
uniform texture3D distance;
uniform writeonly uimage2D out_counts;

layout(push_constant) uniform Params {
  uint paths;
  uint bounces;
  float regularization;
  uint roulette;
};

layout(constant_id = 3) const bool counts_wanted = false;

// Voxel normals are 0.8 degrees off and tangents up to 10: a sharper lobe would only turn that into speckle.
const float kVoxelMinimumAlpha = 0.03;

const float kLeastSurvival = 0.05;   // a path that carries next to nothing still ends within a few vertices

// Is there light that the last ray of a path could meet?
const bool kRaysFindLight = has_emissive || has_environment || has_sun;

PathVertex surface_vertex(Grid grid, ivec2 pixel) {
  PathVertex vertex = first_hit(pixel);
  vec3 normal = vertex.geometric_normal;
  vertex.origin = world_to_grid(grid, vertex.position) + normal * start_offset(normal);
  return vertex;
}

PathVertex voxel_vertex(Grid grid, MarchHit hit, vec3 origin, vec3 direction, VoxelSurface surface,
                        float least_alpha) {
  PathVertex vertex;
  bool front = dot(surface.normal, direction) <= 0.0;
  vec3 normal = front ? surface.normal : -surface.normal;
  // The march stops anywhere inside the voxel. The centre is the best guess at the depth of the surface; sideways the
  // position is kept, or light would come in blocks. Off the centre, 1.5 clearances leave the voxels of a plane.
  vec3 hit_position = origin + direction * hit.t;
  vec3 centre = vec3(hit.voxel) + 0.5;
  vec3 position = hit_position + normal * dot(normal, centre - hit_position);
  vertex.position = grid_to_world(grid, position);
  // A normal that faces away may be that of the other wall of an edge, and its back the outside of the room: then the
  // path goes on from the last place that was empty.
  vec3 lifted = start == kStartSqrt3 ? hit_position + normal * start_offset(normal)
                                     : position + normal * (1.5 * surface_clearance(normal));
  vertex.origin = front ? lifted : origin + direction * max(hit.t - 1.0, 0.0);
  vertex.geometric_normal = normal;
  vertex.basis = make_frame(facing_normal(normal, -direction), surface.tangent);
  vertex.incoming = to_local(vertex.basis, -direction);
  vec2 alpha = max(surface.ward_alpha, vec2(least_alpha));
  vertex.bsdf = Bsdf(surface.albedo, surface.metallic, surface.f0, surface.f90, alpha);
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
    VoxelSurface surface =
        decode_voxel(texelFetch(voxels_albedo, hit.voxel, 0), texelFetch(voxels_normal, hit.voxel, 0),
                     texelFetch(voxels_material, hit.voxel, 0), voxels_normal_bits);
    vec3 from = vertex.position;
    vec3 origin = vertex.origin;
    least_alpha = max(least_alpha, min(scatter.roughness, regularization));
    vertex = voxel_vertex(grid, hit, origin, direction, surface, least_alpha);
    radiance += throughput * emitter_hit(grid, voxels_albedo, hit, surface, from, vertex.position, origin, direction,
                                         scatter);
    if (bounce > bounces) break;
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
