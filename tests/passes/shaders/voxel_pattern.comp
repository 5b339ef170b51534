// Voxels of random occupancy and words, for tests. PCG hash (Jarzynski and Olano 2020).
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image3D out_voxels_albedo;
uniform writeonly image3D out_voxels_normal;
uniform writeonly image3D out_voxels_material;

layout(push_constant) uniform PushBlock {
  int salt;
  float density;
};

uint hash(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

void main() {
  ivec3 voxel = ivec3(gl_GlobalInvocationID);
  ivec3 extent = imageSize(out_voxels_albedo);
  if (any(greaterThanEqual(voxel, extent))) return;
  uint key = hash(uint((voxel.z * extent.y + voxel.y) * extent.x + voxel.x) + hash(uint(salt)));
  bool occupied = float(hash(key) >> 8) < density * 16777216.0;
  imageStore(out_voxels_albedo, voxel, occupied ? vec4(unpackUnorm4x8(hash(key + 1u)).rgb, 1.0) : vec4(0.0));
  imageStore(out_voxels_normal, voxel, occupied ? unpackUnorm4x8(hash(key + 2u)) : vec4(0.0));
  imageStore(out_voxels_material, voxel, occupied ? unpackUnorm4x8(hash(key + 3u)) : vec4(0.0));
}
