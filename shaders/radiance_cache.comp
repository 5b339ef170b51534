// Light that reaches each side of each occupied voxel, as a mean over frames. See passes/radiance_cache.cpp for the ports
// and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/features.glsl"
#include "lib/lights.glsl"
#include "lib/storage.glsl"
#include "lib/voxel_vertex.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
uniform texture3D distance;
uniform texture3D past_front;
uniform texture3D past_back;
uniform writeonly image3D out_light_front;
uniform writeonly image3D out_light_back;

layout(push_constant) uniform Params { uint frames; };

layout(constant_id = 0) const bool past_bound = true;
layout(constant_id = 1) const float out_light_front_largest = 65504.0;
layout(constant_id = 2) const float out_light_back_largest = 65504.0;

const uint kCacheVertex = 200u;   // no path goes so far: the numbers are of the cache alone

// A white matt vertex in the middle of a voxel, on one side of its surface.
PathVertex cache_vertex(Grid grid, ivec3 voxel, vec3 normal, VoxelSurface surface) {
  PathVertex vertex;
  vec3 centre = vec3(voxel) + 0.5;
  vertex.position = grid_to_world(grid, centre);
  vertex.origin = centre + normal * (1.5 * surface_clearance(normal));
  vertex.geometric_normal = normal;
  vertex.basis = make_frame(normal, surface.tangent);
  vertex.incoming = vec3(0.0, 0.0, 1.0);
  vertex.bsdf = Bsdf(vec3(1.0), 0.0, 0.0, 0.0, vec2(1.0));
  return vertex;
}

vec4 past_light(bool front, ivec3 voxel) {
  if (!past_bound || frame.ids.z == 0u) return vec4(0.0);
  return front ? texelFetch(past_front, voxel, 0) : texelFetch(past_back, voxel, 0);
}

// Light that a ray brings: of what it meets, and of what that scattered a frame ago.
vec3 incoming_light(Grid grid, PathVertex vertex, BsdfSample scatter) {
  vec3 direction = to_world(vertex.basis, scatter.direction);
  if (dot(direction, vertex.geometric_normal) <= 0.0) return vec3(0.0);
  MarchHit hit = march_grid(distance, vertex.origin, direction, kFarAway);
  if (!hit.hit) return environment_hit(direction, scatter) + sun_hit(direction, scatter);
  VoxelSurface surface = surface_of(voxels_albedo, voxels_normal, voxels_material, hit.voxel);
  PathVertex met = voxel_vertex(grid, hit, vertex.origin, direction, surface, kVoxelMinimumAlpha);
  vec3 emitted = emitter_hit(grid, voxels_albedo, hit, surface, vertex.position, met.position, vertex.origin, direction,
                             scatter);
  return emitted + albedo_towards(met) * past_light(meets_front(surface, direction), hit.voxel).rgb;
}

// One sample of the light on one side, divided by pi.
vec3 light_sample(Grid grid, ivec3 voxel, vec3 normal, VoxelSurface surface, uint side) {
  PathVertex vertex = cache_vertex(grid, voxel, normal, surface);
  RandomKey key = RandomKey(uvec2(voxel.xy) | uvec2(side << 15u, 0u), frame.ids.x, frame.ids.y, uint(voxel.z), 1u);
  PerLobe direct = direct_light(grid, distance, voxels_normal, voxels_material, vertex, key, kCacheVertex);
  BsdfSample scatter =
      bsdf_sample(vertex.bsdf, vertex.incoming, path_random4(key, kCacheVertex, kDimensionScatter).xyz);
  return direct.diffuse + scatter.weight * incoming_light(grid, vertex, scatter);
}

// The mean with one sample more; of `frames` frames at the most, so that what changed is forgotten.
vec4 with_sample(vec4 past, vec3 value) {
  if (!is_finite(value)) return past;
  float count = min(past.a, float(frames) - 1.0) + 1.0;
  return vec4(past.rgb + (value - past.rgb) / count, count);
}

void store(ivec3 voxel, vec4 front, vec4 back) {
  imageStore(out_light_front, voxel, storable(front, out_light_front_largest));
  imageStore(out_light_back, voxel, storable(back, out_light_back_largest));
}

// The next occupied voxel of the column after z; the grid's depth if there is none. What is empty has no light.
int next_occupied(ivec2 column, int z, int depth) {
  for (++z; z < depth; ++z) {
    ivec3 voxel = ivec3(column, z);
    if (voxel_occupied(texelFetch(voxels_albedo, voxel, 0))) return z;
    store(voxel, vec4(0.0), vec4(0.0));
  }
  return depth;
}

void update(Grid grid, ivec3 voxel) {
  VoxelSurface surface = surface_of(voxels_albedo, voxels_normal, voxels_material, voxel);
  vec4 front = past_light(true, voxel);
  vec4 back = past_light(false, voxel);
  for (uint side = 0u; side < 2u; ++side) {
    vec3 value = light_sample(grid, voxel, side == 0u ? surface.normal : -surface.normal, surface, side);
    if (side == 0u) front = with_sample(front, value);
    else back = with_sample(back, value);
  }
  store(voxel, front, back);
}

// A thread for each column along z: the columns beside, which a device runs in step, have something to do wherever their
// occupied voxels are.
void main() {
  ivec3 size = textureSize(distance, 0);
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(column, size.xy))) return;
  Grid grid = scene_grid(size);
  for (int z = next_occupied(column, -1, size.z); z < size.z; z = next_occupied(column, z, size.z))
    update(grid, ivec3(column, z));
}
