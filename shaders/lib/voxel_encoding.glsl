// The three words of a voxel (paper, section 2.1; passes/bundles.hpp): RGBA8 as the paper has them, or 16 bits a channel
// where the graph stores them so.
//
// albedo    r, g, b: square root of the linear base colour          a: 1 where occupied
// normal    r: azimuth byte   g: polar byte   b: tangent byte       a: metallic
// material  r, g: square root of Ward alpha along the tangent and across it   b: 4 F0   a: emission index
//
// Normal, 8 + 8 bits: spherical with y as the pole, azimuth = byte * 2 pi / 256 from z towards x, polar angle =
// byte * pi / 254, so that all axis directions are exact. Error at most 0.79 degrees.
//
// Tangent byte, 6 + 2 bits: the basis (X, Y) is made of the two bytes of the normal, not of the normal itself, so that
// encoder and decoder cannot disagree: X points along growing azimuth, Y = normal x X. Bits 0..5: the tangent's shadow
// on X from -1 to 1; bit 6: the tangent points away from Y; bit 7: the bitangent points away from Y. Error at most 10.3
// degrees (the shadow is a cosine, coarse near +-X), 1.3 on average.
//
// With 16 bits a channel roots and fractions are the same numbers in finer steps, and the emission index stays in 255ths;
// azimuth = word * 2 pi / 65536, polar angle = word * pi / 65534, error at most 0.0031 degrees; the tangent is bits 0..14:
// its angle from X towards Y in 32768ths of a turn, bit 15: the basis is left-handed, error at most 0.0055 degrees.
#ifndef LIGHTLOOM_LIB_VOXEL_ENCODING
#define LIGHTLOOM_LIB_VOXEL_ENCODING

#include "lib/basis.glsl"

const float kVoxelPi = 3.14159265358979;
const float kLeastWardAlpha = 1e-3;   // below, a lobe is narrower than any normal stored here is exact

struct VoxelSurface {
  vec3 albedo;        // linear base colour
  vec3 normal;        // unit, of the front face
  vec3 tangent;       // unit, orthogonal to the normal
  float handedness;   // bitangent = cross(normal, tangent) * handedness
  float metallic;
  vec2 ward_alpha;    // along the tangent and across it, kLeastWardAlpha..1
  float f0;           // specular reflectance of the dielectric at normal incidence, 0..0.25
  float f90;          // the same at grazing incidence; decoded from f0: 1 from 0.04 on, proportional below
  uint emission;      // index into the emission table; 0: none
};

bool is_number(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

const uint kWideBits = 16u;   // of a channel; 8 otherwise

// The whole number that stands for 1.
float unorm_steps(uint bits) { return bits == kWideBits ? 65535.0 : 255.0; }

// x in [0,1] to whole steps; what is not a number becomes 0.
uint to_steps(float x, uint bits) { return is_number(x) ? uint(clamp(x, 0.0, 1.0) * unorm_steps(bits) + 0.5) : 0u; }
uint from_unorm(float texel, uint bits) { return uint(texel * unorm_steps(bits) + 0.5); }
uint from_unorm(float texel) { return from_unorm(texel, 8u); }
vec4 to_unorm(uvec4 steps, uint bits) { return vec4(steps) / unorm_steps(bits); }

uvec2 encode_normal(vec3 normal, uint bits) {
  normal = safe_normalize(normal, vec3(0.0, 1.0, 0.0));
  float across = length(normal.xz);
  float azimuth = across > 0.0 ? atan(normal.x, normal.z) : 0.0;   // (-pi, pi]
  float polar = atan(across, normal.y);                            // [0, pi]
  if (bits == kWideBits)
    return uvec2(int(round(azimuth * (32768.0 / kVoxelPi))) & 65535,
                 min(uint(round(polar * (65534.0 / kVoxelPi))), 65534u));
  uint turn = uint(int(round(azimuth * (128.0 / kVoxelPi))) & 255);
  return uvec2(turn, min(uint(round(polar * (254.0 / kVoxelPi))), 254u));
}

// The frame that the two words of a normal stand for: orthonormal, X x Y = normal.
void decode_normal_frame(uvec2 words, uint bits, out vec3 normal, out vec3 x, out vec3 y) {
  // Signed, because sine and cosine are only exact enough between -pi and pi.
  float azimuth, polar;
  if (bits == kWideBits) {
    azimuth = float(int(words.x) - (words.x < 32768u ? 0 : 65536)) * (kVoxelPi / 32768.0);
    polar = float(min(words.y, 65534u)) * (kVoxelPi / 65534.0);
  } else {
    azimuth = float(int(words.x) - (words.x < 128u ? 0 : 256)) * (kVoxelPi / 128.0);
    polar = float(min(words.y, 254u)) * (kVoxelPi / 254.0);
  }
  vec2 around = normalize(vec2(sin(azimuth), cos(azimuth)));
  vec2 down = normalize(vec2(sin(polar), cos(polar)));
  normal = vec3(down.x * around.x, down.y, down.x * around.y);
  x = vec3(around.y, 0.0, -around.x);
  y = vec3(-down.y * around.x, down.x, -down.y * around.y);
}

uint encode_tangent(uvec2 normal_words, uint bits, vec3 tangent, float handedness) {
  vec3 normal, x, y;
  decode_normal_frame(normal_words, bits, normal, x, y);
  tangent = orthogonal_tangent(normal, tangent);
  if (bits == kWideBits) {
    float angle = atan(dot(tangent, y), dot(tangent, x));   // never both 0
    return uint(int(round(angle * (16384.0 / kVoxelPi))) & 32767) | (handedness < 0.0 ? 32768u : 0u);
  }
  uint shadow = uint(clamp(dot(tangent, x) * 0.5 + 0.5, 0.0, 1.0) * 63.0 + 0.5);
  uint away = dot(tangent, y) < 0.0 ? 64u : 0u;
  // bitangent . Y = handedness * (tangent . X); the shadow's middle lies between two codes, so its sign is never lost.
  float sign_of_shadow = shadow >= 32u ? 1.0 : -1.0;
  uint bitangent_away = sign_of_shadow * (handedness < 0.0 ? -1.0 : 1.0) < 0.0 ? 128u : 0u;
  return shadow | away | bitangent_away;
}

void decode_tangent(uint code, uint bits, vec3 x, vec3 y, out vec3 tangent, out float handedness) {
  if (bits == kWideBits) {
    int turn = int(code & 32767u);
    float angle = float(turn - (turn < 16384 ? 0 : 32768)) * (kVoxelPi / 16384.0);
    vec2 around = normalize(vec2(cos(angle), sin(angle)));
    tangent = around.x * x + around.y * y;
    handedness = (code & 32768u) != 0u ? -1.0 : 1.0;
    return;
  }
  float along = float(code & 63u) * (2.0 / 63.0) - 1.0;
  float across = sqrt(max(1.0 - along * along, 0.0));
  tangent = along * x + ((code & 64u) != 0u ? -across : across) * y;
  float sign_of_shadow = along >= 0.0 ? 1.0 : -1.0;
  handedness = (code & 128u) != 0u ? -sign_of_shadow : sign_of_shadow;
}

vec4 encode_voxel_normal(VoxelSurface s, uint bits) {
  uvec2 direction = encode_normal(s.normal, bits);
  return to_unorm(uvec4(direction, encode_tangent(direction, bits, s.tangent, s.handedness), to_steps(s.metallic, bits)),
                  bits);
}

// Bits a channel of each of the three: x of albedo, y of normal, z of material.
void encode_voxel(VoxelSurface s, uvec3 bits, out vec4 albedo, out vec4 normal, out vec4 material) {
  albedo = vec4(to_unorm(uvec4(to_steps(sqrt(max(s.albedo.r, 0.0)), bits.x), to_steps(sqrt(max(s.albedo.g, 0.0)), bits.x),
                               to_steps(sqrt(max(s.albedo.b, 0.0)), bits.x), 0u), bits.x).rgb, 1.0);
  normal = encode_voxel_normal(s, bits.y);
  material = vec4(to_unorm(uvec4(to_steps(sqrt(max(s.ward_alpha.x, 0.0)), bits.z),
                                 to_steps(sqrt(max(s.ward_alpha.y, 0.0)), bits.z), to_steps(4.0 * s.f0, bits.z), 0u),
                           bits.z).rgb,
                  float(min(s.emission, 255u)) / 255.0);
}

bool voxel_occupied(vec4 albedo) { return albedo.a > 0.5; }

// Unit normal of the front face, from the texel of the normal image.
vec3 decode_voxel_normal(vec4 texel, uint bits) {
  vec3 normal, x, y;
  decode_normal_frame(uvec2(from_unorm(texel.r, bits), from_unorm(texel.g, bits)), bits, normal, x, y);
  return normal;
}

// Never NaN, whatever the bits. What the albedo and the material hold reads the same with any number of them.
VoxelSurface decode_voxel(vec4 albedo, vec4 normal, vec4 material, uint normal_bits) {
  VoxelSurface s;
  s.albedo = albedo.rgb * albedo.rgb;
  vec3 x, y;
  decode_normal_frame(uvec2(from_unorm(normal.r, normal_bits), from_unorm(normal.g, normal_bits)), normal_bits, s.normal,
                      x, y);
  decode_tangent(from_unorm(normal.b, normal_bits), normal_bits, x, y, s.tangent, s.handedness);
  s.metallic = normal.a;
  s.ward_alpha = clamp(material.rg * material.rg, kLeastWardAlpha, 1.0);
  s.f0 = material.b * 0.25;
  s.f90 = min(s.f0 / 0.04, 1.0);
  s.emission = from_unorm(material.a);
  return s;
}

// The texel of an occupied voxel's normal image as one of another width stores it; the others need no more than a copy.
vec4 recode_voxel_normal(vec4 texel, uint from, uint to) {
  if (from == to) return texel;
  return encode_voxel_normal(decode_voxel(vec4(0.0), texel, vec4(0.0), from), to);
}

#endif
