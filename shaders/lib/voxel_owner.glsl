// Who owns a voxel: of all triangles that claim it the one with the greatest key.
#ifndef LIGHTLOOM_LIB_VOXEL_OWNER
#define LIGHTLOOM_LIB_VOXEL_OWNER

#include "lib/features.glsl"
#include "lib/scene.glsl"

const uint kPriorityDrawOrder = 0u;   // the last in draw order
const uint kPriorityEmissive = 1u;    // before that, those whose material emits
layout(constant_id = 27) const uint priority = 0u;

const uint kEmissiveOwner = 0x80000000u;

uint owner_key(uint triangle, uint material) {
  bool first = priority == kPriorityEmissive && has_emissive && materials[material].flags.z != 0u;
  return (triangle + 1u) | (first ? kEmissiveOwner : 0u);
}

// The triangle of a key that is not 0.
uint owner_triangle(uint key) { return (key & ~kEmissiveOwner) - 1u; }

#endif
