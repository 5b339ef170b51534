// Samples the light that reaches occupied voxels, after radiance_cache_keep.comp. See passes/radiance_cache.cpp for the
// ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/cached_light.glsl"
#include "lib/storage.glsl"
#include "lib/voxel_path.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image3D out_light;

layout(push_constant) uniform Params {
  uint bounces;
  float regularization;
  uint roulette;
  uint frames;
  uint interval;
};

layout(constant_id = 0) const float out_light_largest = 65504.0;

// Where rays leave a voxel [grid units].
vec3 ray_origin(ivec3 voxel, vec3 normal) { return vec3(voxel) + 0.5 + normal * (1.5 * surface_clearance(normal)); }

// A white matt vertex in the middle of a voxel, on the side of its normal.
PathVertex cache_vertex(Grid grid, ivec3 voxel) {
  VoxelSurface surface = surface_of(voxels_albedo, voxels_normal, voxels_material, voxel);
  PathVertex vertex;
  vertex.position = grid_to_world(grid, vec3(voxel) + 0.5);
  vertex.origin = ray_origin(voxel, surface.normal);
  vertex.geometric_normal = surface.normal;
  vertex.basis = make_frame(surface.normal, surface.tangent);
  vertex.incoming = vec3(0.0, 0.0, 1.0);
  vertex.bsdf = Bsdf(vec3(1.0), 0.0, 0.0, 0.0, vec2(1.0));
  return vertex;
}

// Is there empty space before an occupied voxel? Rays that started among others might come out behind a wall.
bool is_open(ivec3 voxel) {
  vec3 normal = decode_voxel_normal(texelFetch(voxels_normal, voxel, 0), voxels_normal_bits);
  return voxel_is_empty(voxels_albedo, ivec3(floor(ray_origin(voxel, normal))));
}

// One sample of the light that the voxel would scatter if it were white and matt.
vec3 light_sample(Grid grid, ivec3 voxel) {
  uvec2 place = uvec2(voxel.xy) | (1u << 15u);   // no pixel's: the numbers are of the cache alone
  RandomKey key = RandomKey(place, frame.ids.x, frame.ids.y, uint(voxel.z), 1u);
  PathLimits limits = PathLimits(bounces, regularization, roulette, frame.ids.z > 0u ? 1u : 0u, 0.0);
  return trace_path(grid, cache_vertex(grid, voxel), key, limits).diffuse;
}

// The mean with one sample more; of `frames` frames at the most, so that what changed is forgotten.
vec4 with_sample(vec4 past, vec3 value) {
  if (!is_finite(value)) return past;
  float count = min(past.a, float(frames) - 1.0) + 1.0;
  return vec4(past.rgb + (value - past.rgb) / count, count);
}

void store_light(ivec3 voxel, vec4 light) { imageStore(out_light, voxel, storable(light, out_light_largest)); }

// Is it the voxel's turn? At once where nothing is known yet.
bool is_due(ivec3 voxel, vec4 past) {
  uint turn = uint(voxel.x + voxel.y + voxel.z) + frame.ids.x;
  return past.a == 0.0 || turn % interval == 0u;
}

// The next voxel of the column from z on whose turn it is; the grid's depth if there is none. Of a buried one nothing is
// known.
int next_due(ivec2 column, int z, int depth) {
  while (z < depth) {
    ivec3 voxel = ivec3(column, z);
    int empty = voxel_distance(distance, voxel);
    if (empty == 0 && is_due(voxel, past_light(voxel))) {
      if (is_open(voxel)) return z;
      store_light(voxel, vec4(0.0));
    }
    z += max(empty, 1);
  }
  return depth;
}

// A thread for each column along z: the columns beside, which a device runs in step, have something to do wherever their
// occupied voxels are.
void main() {
  ivec3 size = textureSize(distance, 0);
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(column, size.xy))) return;
  Grid grid = scene_grid(size);
  for (int z = next_due(column, 0, size.z); z < size.z; z = next_due(column, z + 1, size.z)) {
    ivec3 voxel = ivec3(column, z);
    store_light(voxel, with_sample(past_light(voxel), light_sample(grid, voxel)));
  }
}
