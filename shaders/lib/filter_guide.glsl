// What the spatial filters ask of a neighbour, in one texel of 128 bits. x: 24 bits of the object, 8 of the error, whose
// logarithm is stored. y: unit normal, octahedral (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 3(2)), twice 12 bits, and 8 bits of a power of two. z, w: position from the viewer (of
// an orthographic camera: from the middle of the scene) in parts of that power, three times 16 bits; the upper half of
// the variance as a float.
#ifndef LIGHTLOOM_LIB_FILTER_GUIDE
#define LIGHTLOOM_LIB_FILTER_GUIDE

struct Guide {
  uint object;      // 0: background; objects 2^24 apart are told for one
  vec3 normal;      // within 0.001
  vec3 position;    // from that point [m], within 2^-15 of its largest coordinate
  float variance;   // of the luminance, within 1/256 of itself
  float error;      // relative standard error of the radiance (lib/relative_error.glsl), within 1/40 of itself
};

const float kNormalSteps = 4094.0;
const float kPositionSteps = 32767.0;
// Errors from 2^-9 to 2^7, 16 steps for a factor of 2; what lies outside is full or no length to every filter.
const float kErrorSteps = 16.0;
const float kErrorOffset = 144.0;

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

uvec4 pack_guide(Guide guide) {
  uvec2 normal = uvec2(round((octahedral(guide.normal) * 0.5 + 0.5) * kNormalSteps));
  uint exponent = exponent_above(guide.position);
  ivec3 place = ivec3(round(guide.position / uintBitsToFloat(exponent << 23u) * kPositionSteps));
  uint variance = (floatBitsToUint(guide.variance) + 0x8000u) >> 16u;
  uint error = uint(clamp(round(log2(max(guide.error, 1e-30)) * kErrorSteps + kErrorOffset), 0.0, 255.0));
  return uvec4((guide.object & 0xFFFFFFu) | error << 24u, normal.x | normal.y << 12u | exponent << 24u,
               (uint(place.x) & 0xFFFFu) | uint(place.y) << 16u, (uint(place.z) & 0xFFFFu) | variance << 16u);
}

Guide unpack_guide(uvec4 packed) {
  vec2 normal = vec2(uvec2(packed.y, packed.y >> 12u) & 0xFFFu) * (2.0 / kNormalSteps) - 1.0;
  float power = uintBitsToFloat(packed.y >> 24u << 23u);
  ivec3 place = ivec3(bitfieldExtract(int(packed.z), 0, 16), int(packed.z) >> 16, bitfieldExtract(int(packed.w), 0, 16));
  return Guide(packed.x & 0xFFFFFFu, from_octahedral(normal), vec3(place) * (power / kPositionSteps),
               uintBitsToFloat(packed.w & 0xFFFF0000u), exp2((float(packed.x >> 24u) - kErrorOffset) / kErrorSteps));
}

#endif
