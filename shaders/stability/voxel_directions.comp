// What normals and tangents become in the two bytes and the one of a voxel: texel i of `width` * height directions that
// are spread evenly over the sphere (Fibonacci lattice), each with a tangent of its own.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/voxel_encoding.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_normal;            // as it was
uniform writeonly image2D out_stored_normal;     // as it is read
uniform writeonly image2D out_tangent;           // in the plane that belongs to the stored normal
uniform writeonly image2D out_stored_tangent;

void main() {
  ivec2 size = imageSize(out_normal);
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size))) return;
  uint index = uint(texel.y * size.x + texel.x);
  float height = 1.0 - (2.0 * float(index) + 1.0) / float(size.x * size.y);
  // 2^32 times the golden ratio's fraction: the turn stays exact however many there are.
  float azimuth = float(index * 2654435769u >> 8) * (2.0 * kVoxelPi / 16777216.0);
  float across = sqrt(max(1.0 - height * height, 0.0));
  vec3 normal = normalize(vec3(across * cos(azimuth), height, across * sin(azimuth)));

  VoxelSurface surface;
  surface.albedo = vec3(0.5);
  surface.normal = normal;
  surface.handedness = 1.0;
  surface.metallic = 0.0;
  surface.ward_alpha = vec2(0.5);
  surface.f0 = 0.04;
  surface.f90 = 1.0;
  surface.emission = 0u;
  uvec2 bytes = encode_normal(normal, 8u);
  vec3 stored, x, y;
  decode_normal_frame(bytes, 8u, stored, x, y);
  float turn = float((index * 747796405u + 2891336453u) >> 8) * (2.0 * kVoxelPi / 16777216.0);
  surface.tangent = cos(turn) * x + sin(turn) * y;

  vec4 albedo, packed_normal, material;
  encode_voxel(surface, uvec3(8u), albedo, packed_normal, material);
  VoxelSurface read = decode_voxel(albedo, packed_normal, material, 8u);
  imageStore(out_normal, texel, vec4(normal, 0.0));
  imageStore(out_stored_normal, texel, vec4(read.normal, 0.0));
  imageStore(out_tangent, texel, vec4(surface.tangent, 0.0));
  imageStore(out_stored_tangent, texel, vec4(read.tangent, read.handedness));
}
