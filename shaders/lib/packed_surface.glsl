// What histories ask of the surface in a pixel, in one texel of 128 bits: 24 bits of the object and 8 of the material; the
// point (lib/packed_point.glsl); above it 16 more bits of the material.
#ifndef LIGHTLOOM_LIB_PACKED_SURFACE
#define LIGHTLOOM_LIB_PACKED_SURFACE

#include "lib/packed_point.glsl"

const uint kPackedIds = 1u << 24u;   // objects and materials so far apart are told for one

struct PackedSurface {
  uint object;     // 0: background
  uint material;
  SurfacePoint point;
};

uvec4 pack_surface(PackedSurface surface) {
  uvec3 point = pack_point(surface.point);
  uint material = surface.material % kPackedIds;
  return uvec4(surface.object % kPackedIds | material << 24u, point.xy, point.z | material >> 8u << 16u);
}

PackedSurface unpack_surface(uvec4 packed) {
  return PackedSurface(packed.x % kPackedIds, packed.x >> 24u | packed.w >> 16u << 8u, unpack_point(packed.yzw));
}

#endif
