// The exposed faces of emissive voxels as light: what rays meet is what next event estimation samples. The pass
// `emissive_faces` lists them; here is how a face is coded and weighted, for the list and for those who look it up.
#ifndef LIGHTLOOM_LIB_EMISSIVE_FACES
#define LIGHTLOOM_LIB_EMISSIVE_FACES

#include "lib/scene.glsl"
#include "lib/voxel_encoding.glsl"

// The list is an image of rg32_uint texels in rows. Texel 0: number of faces in it, sum of their weights; texel i: code
// of face i - 1, sum of the weights of faces 0 to i - 1. The largest sum fits into 32 bits.
const int kFaceRow = 1024;
const uint kFaceCapacity = 1048575u;
const uint kFaceWeightLimit = 4095u;

// Sums of face_emittance are in whole numbers of 1/512, which hold 8 million faces.
const float kFacePowerUnit = 512.0;

ivec2 face_texel(uint index) { return ivec2(int(index) % kFaceRow, int(index) / kFaceRow); }

// Faces 0 to 5: -x, +x, -y, +y, -z, +z.
ivec3 face_normal(uint face) {
  ivec3 normal = ivec3(0);
  normal[face / 2u] = (face & 1u) == 0u ? -1 : 1;
  return normal;
}

uint face_index(ivec3 normal) {
  uint axis = normal.x != 0 ? 0u : normal.y != 0 ? 1u : 2u;
  return 2u * axis + (normal[axis] > 0 ? 1u : 0u);
}

// 30 bits, in the order of the list: columns of voxels by y, then x; in each by z, then face.
uint face_code(ivec3 voxel, uint face) {
  return (uint(voxel.y) << 21u) | (uint(voxel.x) << 12u) | (uint(voxel.z) << 3u) | face;
}

ivec3 face_voxel(uint code) { return ivec3((code >> 12u) & 511u, (code >> 21u) & 511u, (code >> 3u) & 511u); }

// Power of a face over that of one which emits into the whole hemisphere: a one-sided emitter of normal n sends its
// radiance only into directions above its own plane, and of those a face of normal a sees pi (1 + a . n) / 2.
float face_emittance(uint emission, vec3 voxel_normal, uint face) {
  if (lights.emissions[emission].sides.x > 0.5) return 1.0;
  precise float cosine = dot(vec3(face_normal(face)), voxel_normal);
  return clamp(0.5 + 0.5 * cosine, 0.0, 1.0);
}

// Weight with which a face is drawn, in proportion to the luminance of its power; whole numbers, so that sums do not
// depend on their order. 0: never.
uint face_weight(uint emission, vec3 voxel_normal, uint face) {
  precise float share = face_emittance(emission, voxel_normal, face) * lights.emissions[emission].radiance.w;
  if (!(share > 0.0) || face_emittance(emission, voxel_normal, face) < 1e-3) return 0u;
  return clamp(uint(share * float(kFaceWeightLimit) + 0.5), 1u, kFaceWeightLimit);
}

// Is a voxel empty, or outside of the grid?
bool voxel_is_empty(texture3D albedo, ivec3 voxel) {
  bool inside = all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, textureSize(albedo, 0)));
  return !inside || !voxel_occupied(texelFetch(albedo, voxel, 0));
}

#endif
