// A point of a surface in 104 bits: unit normal, octahedral (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 3(2)), twice 12 bits, and 8 bits of a power of two; position from the viewer (of an
// orthographic camera: from the middle of the scene) in parts of that power, three times 16 bits. The upper half
// of the last word is free.
#ifndef LIGHTLOOM_LIB_PACKED_POINT
#define LIGHTLOOM_LIB_PACKED_POINT

struct SurfacePoint {
  vec3 normal;     // within 0.001
  vec3 position;   // from that point [m], within 2^-15 of its largest coordinate
};

const float kNormalSteps = 4094.0;
const float kPositionSteps = 32767.0;

vec2 octahedral(vec3 direction) {
  vec3 n = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  vec2 side = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * side;
}

vec3 from_octahedral(vec2 place) {
  vec3 n = vec3(place, 1.0 - abs(place.x) - abs(place.y));
  float folded = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -folded : folded;
  n.y += n.y >= 0.0 ? -folded : folded;
  return normalize(n);
}

// The exponent of the power of two above the largest coordinate, as a float has it; that power is a float as well.
uint exponent_above(vec3 position) {
  float largest = max(abs(position.x), max(abs(position.y), abs(position.z)));
  return min((floatBitsToUint(largest) >> 23u) + 1u, 254u);
}

// The lower 16 bits of the last word, and all others.
uvec3 pack_point(SurfacePoint point) {
  uvec2 normal = uvec2(round((octahedral(point.normal) * 0.5 + 0.5) * kNormalSteps));
  uint exponent = exponent_above(point.position);
  ivec3 place = ivec3(round(point.position / uintBitsToFloat(exponent << 23u) * kPositionSteps));
  return uvec3(normal.x | normal.y << 12u | exponent << 24u, (uint(place.x) & 0xFFFFu) | uint(place.y) << 16u,
               uint(place.z) & 0xFFFFu);
}

SurfacePoint unpack_point(uvec3 packed) {
  vec2 normal = vec2(uvec2(packed.x, packed.x >> 12u) & 0xFFFu) * (2.0 / kNormalSteps) - 1.0;
  float power = uintBitsToFloat(packed.x >> 24u << 23u);
  ivec3 place = ivec3(bitfieldExtract(int(packed.y), 0, 16), int(packed.y) >> 16, bitfieldExtract(int(packed.z), 0, 16));
  return SurfacePoint(from_octahedral(normal), vec3(place) * (power / kPositionSteps));
}

#endif
