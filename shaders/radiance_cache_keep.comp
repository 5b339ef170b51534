// Light of a frame ago for all voxels; none for those that are empty now. See passes/radiance_cache.cpp for the ports and
// params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/cached_light.glsl"
#include "lib/storage.glsl"
#include "lib/voxel_distance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D distance;
uniform writeonly image3D out_light;

layout(constant_id = 0) const float out_light_largest = 65504.0;

void main() {
  ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(voxel, textureSize(distance, 0)))) return;
  vec4 light = voxel_distance(distance, voxel) == 0 ? past_light(voxel) : vec4(0.0);
  imageStore(out_light, voxel, storable(light, out_light_largest));
}
