// Light that reaches each occupied voxel, as a mean over frames. See passes/radiance_cache.cpp for the ports
// and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

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

// A white matt vertex in the middle of a voxel, on the side of its normal.
PathVertex cache_vertex(Grid grid, ivec3 voxel) {
  VoxelSurface surface = surface_of(voxels_albedo, voxels_normal, voxels_material, voxel);
  PathVertex vertex;
  vec3 centre = vec3(voxel) + 0.5;
  vertex.position = grid_to_world(grid, centre);
  vertex.origin = centre + surface.normal * (1.5 * surface_clearance(surface.normal));
  vertex.geometric_normal = surface.normal;
  vertex.basis = make_frame(surface.normal, surface.tangent);
  vertex.incoming = vec3(0.0, 0.0, 1.0);
  vertex.bsdf = Bsdf(vec3(1.0), 0.0, 0.0, 0.0, vec2(1.0));
  return vertex;
}

vec4 past_light(ivec3 voxel) {
  return cache_bound && frame.ids.z > 0u ? texelFetch(cache, voxel, 0) : vec4(0.0);
}

// One sample of the light that the voxel would scatter if it were white and matt.
vec3 light_sample(Grid grid, ivec3 voxel) {
  uvec2 place = uvec2(voxel.xy) | (1u << 15u);   // no pixel's: the numbers are of the cache alone
  RandomKey key = RandomKey(place, frame.ids.x, frame.ids.y, uint(voxel.z), 1u);
  PathLimits limits = PathLimits(bounces, regularization, roulette, frame.ids.z > 0u ? 1u : 0u);
  return trace_path(grid, cache_vertex(grid, voxel), key, limits).diffuse;
}

// The mean with one sample more; of `frames` frames at the most, so that what changed is forgotten.
vec4 with_sample(vec4 past, vec3 value) {
  if (!is_finite(value)) return past;
  float count = min(past.a, float(frames) - 1.0) + 1.0;
  return vec4(past.rgb + (value - past.rgb) / count, count);
}

void store(ivec3 voxel, vec4 light) { imageStore(out_light, voxel, storable(light, out_light_largest)); }

// Is it the voxel's turn? At once where nothing is known yet.
bool is_due(ivec3 voxel, vec4 past) {
  uint turn = uint(voxel.x + voxel.y + voxel.z) + frame.ids.x;
  return past.a == 0.0 || turn % interval == 0u;
}

// The next voxel of the column after z whose turn it is; the grid's depth if there is none. Empty ones have no light, the
// others keep theirs.
int next_due(ivec2 column, int z, int depth) {
  for (++z; z < depth; ++z) {
    ivec3 voxel = ivec3(column, z);
    vec4 light = vec4(0.0);
    if (voxel_occupied(texelFetch(voxels_albedo, voxel, 0))) {
      light = past_light(voxel);
      if (is_due(voxel, light)) return z;
    }
    store(voxel, light);
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
  for (int z = next_due(column, -1, size.z); z < size.z; z = next_due(column, z, size.z)) {
    ivec3 voxel = ivec3(column, z);
    store(voxel, with_sample(past_light(voxel), light_sample(grid, voxel)));
  }
}
