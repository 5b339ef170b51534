// A sample of the light of emissive faces that stands for many: resampled importance sampling (Talbot et al. 2005) kept in
// reservoirs that pixels and frames hand on (Bitterli et al. 2020, "Spatiotemporal reservoir resampling").
//
// Samples are points on faces, and densities are per area of a face [voxel^-2], which is the same for every vertex: handing
// a sample on needs no Jacobian. `weight` times a function at the sample is an unbiased estimate of that function's
// integral over all faces from which the reservoir's pixel may get light (Lin et al. 2022, "Generalized resampled
// importance sampling").
#ifndef LIGHTLOOM_LIB_RESERVOIR
#define LIGHTLOOM_LIB_RESERVOIR

#include "lib/sampling.glsl"

struct Reservoir {
  uint code;      // face_code of the sample
  uint place;     // where on its face, twice 16 bits
  float weight;   // what takes the place of 1 / pdf of the sample [voxel^2]; 0: there is no sample
  float count;    // frames whose candidates it was chosen from; 0: it knows nothing
};
const Reservoir kNoReservoir = Reservoir(0u, 0u, 0.0, 0.0);

uvec4 pack_reservoir(Reservoir reservoir) {
  return uvec4(reservoir.code, reservoir.place, floatBitsToUint(reservoir.weight), floatBitsToUint(reservoir.count));
}

// What is not a number, or below 0, is no sample.
Reservoir unpack_reservoir(uvec4 texel) {
  float weight = uintBitsToFloat(texel.z);
  float count = uintBitsToFloat(texel.w);
  bool sound = is_finite(weight) && is_finite(count) && weight >= 0.0 && count >= 0.0;
  return sound ? Reservoir(texel.x, texel.y, weight, count) : kNoReservoir;
}

// The words of a random draw with those bits alone that `place` keeps, each in the middle of its step.
uvec4 in_steps(uvec4 bits) { return uvec4(bits.x, (bits.yzw & 0xFFFF0000u) | 0x8000u); }

// The two coordinates along the face of what such words say of it. `axis`: across the face.
uint pack_place(uvec4 bits, int axis) {
  uvec2 along = axis == 0 ? bits.zw : axis == 1 ? bits.yw : bits.yz;
  return (along.x >> 16u) | (along.y & 0xFFFF0000u);
}

vec3 unpack_place(uint place, int axis) {
  vec2 along = (vec2(place & 0xFFFFu, place >> 16u) + 0.5) / 65536.0;
  return axis == 0 ? vec3(0.0, along) : axis == 1 ? vec3(along.x, 0.0, along.y) : vec3(along, 0.0);
}

// One sample out of a stream, each with a chance in proportion to its resampling weight.
struct Stream {
  uint code;
  uint place;
  float target;   // density that the sample was to have, but for a factor
  float sum;      // of the resampling weights so far
};
const Stream kEmptyStream = Stream(0u, 0u, 0.0, 0.0);

// `u`: uniform in [0, 1). What has no weight, or one that is not a number, never comes to be the sample.
void add_to_stream(inout Stream stream, uint code, uint place, float target, float weight, float u) {
  if (!(weight > 0.0 && target > 0.0) || !is_finite(weight) || !is_finite(target)) return;
  stream.sum += weight;
  if (u * stream.sum >= weight) return;
  stream.code = code;
  stream.place = place;
  stream.target = target;
}

Reservoir reservoir_of(Stream stream, float count) {
  float weight = stream.target > 0.0 ? stream.sum / stream.target : 0.0;
  return Reservoir(stream.code, stream.place, is_finite(weight) ? weight : 0.0, count);
}

// Shares of reservoirs in a sample that more than one of them could have held: pairwise, each of the others with the
// pixel's own (Bitterli 2022, "Correlations and reuse for fast and accurate physically based light transport", section
// 9.1.3, with counts for numbers of samples). For any sample at which the own target is above 0 the shares add up to 1,
// as count / all + sum over others of (count of other / all) (share of own + share of other); a reservoir whose pixel
// cannot have the sample gets none.
//
// `own_target` and `other_target`: what the two pixels' targets say of the sample. `others`: counts of all others.
float own_pair_share(float own_count, float own_target, float others, float other_target) {
  float own = own_count * own_target;
  return own > 0.0 ? own / (own + others * other_target) : 0.0;
}

float other_pair_share(float own_count, float own_target, float others, float other_target) {
  float other = others * other_target;
  return other > 0.0 ? other / (own_count * own_target + other) : 0.0;
}

#endif
