// Searches a piece of an image, as raw texels, for NaN, infinity and the pattern of poison. Host side:
// framework/run/value_scan.cpp.
#version 460

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint channel_kind = 0u;
const uint kFloat32 = 0u;
const uint kFloat16 = 1u;
const uint kUnorm8 = 3u;   // 2: 32-bit integers
const uint kUnorm16 = 4u;
// Texels that hold the pattern in all channels are counted apart, and all texels are digested.
layout(constant_id = 1) const bool poisoned = false;
// 0: searches; 1: a single invocation fetches the texel that was found.
layout(constant_id = 2) const uint stage = 0u;

layout(push_constant) uniform Params {
  uint first_texel;   // of the piece, counted over the whole image, x fastest, then y, then z
  uint texel_count;   // of the piece
  uint channels;
  uint record_index;
  uint pattern;       // of each channel
};

struct Record {
  uint scanned;
  uint nan_texels;
  uint infinite_texels;
  uint pattern_texels;
  uint bad_from_end;       // 2^32 - 1 - number of the first texel with NaN or infinity; 0: none
  uint pattern_from_end;   // alike, of the first with the pattern
  uint digest[2];          // does not depend on the order of texels
  uint texel[4];           // raw channels of the first with NaN or infinity
};

layout(std430) readonly buffer Texels { uint words[]; };
layout(std430) buffer Records { Record records[]; };

uint channel_of(uint texel, uint channel) {
  uint index = texel * channels + channel;
  if (channel_kind == kFloat16 || channel_kind == kUnorm16) return (words[index >> 1u] >> (16u * (index & 1u))) & 0xffffu;
  if (channel_kind == kUnorm8) return (words[index >> 2u] >> (8u * (index & 3u))) & 0xffu;
  return words[index];
}

// IEEE 754: all bits of the exponent are set; infinity has no others. By bits, since arithmetic may take NaN for
// impossible.
bool is_special(uint bits) {
  if (channel_kind == kFloat32) return (bits & 0x7f800000u) == 0x7f800000u;
  return channel_kind == kFloat16 && (bits & 0x7c00u) == 0x7c00u;
}
bool is_nan_special(uint bits) {
  return (bits & (channel_kind == kFloat32 ? 0x007fffffu : 0x03ffu)) != 0u;
}

// The finalizer of MurmurHash3: each bit of the argument reaches all bits of the result.
uint mixed(uint bits) {
  bits = (bits ^ (bits >> 16u)) * 0x85ebca6bu;
  bits = (bits ^ (bits >> 13u)) * 0xc2b2ae35u;
  return bits ^ (bits >> 16u);
}

void search() {
  uint nan_texels = 0u;
  uint infinite_texels = 0u;
  uint pattern_texels = 0u;
  uint bad_from_end = 0u;
  uint pattern_from_end = 0u;
  uvec2 digest = uvec2(0u);
  uint step_size = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint texel = gl_GlobalInvocationID.x; texel < texel_count; texel += step_size) {
    bool has_nan = false;
    bool has_infinity = false;
    bool all_pattern = poisoned;
    for (uint channel = 0u; channel < channels; ++channel) {
      uint bits = channel_of(texel, channel);
      if (is_special(bits)) {
        if (is_nan_special(bits)) has_nan = true;
        else has_infinity = true;
      }
      if (!poisoned) continue;
      all_pattern = all_pattern && bits == pattern;
      uint place = (first_texel + texel) * channels + channel;
      digest += uvec2(mixed(bits ^ (place * 0x9e3779b9u)), mixed(bits + place * 0x7feb352du + 0x165667b1u));
    }
    uint from_end = 0xffffffffu - (first_texel + texel);
    if (all_pattern) {
      ++pattern_texels;
      pattern_from_end = max(pattern_from_end, from_end);
    } else if (has_nan || has_infinity) {
      nan_texels += uint(has_nan);
      infinite_texels += uint(has_infinity);
      bad_from_end = max(bad_from_end, from_end);
    }
  }
  if (nan_texels > 0u) atomicAdd(records[record_index].nan_texels, nan_texels);
  if (infinite_texels > 0u) atomicAdd(records[record_index].infinite_texels, infinite_texels);
  if (bad_from_end > 0u) atomicMax(records[record_index].bad_from_end, bad_from_end);
  if (!poisoned) return;
  if (pattern_texels > 0u) atomicAdd(records[record_index].pattern_texels, pattern_texels);
  if (pattern_from_end > 0u) atomicMax(records[record_index].pattern_from_end, pattern_from_end);
  atomicAdd(records[record_index].digest[0], digest.x);
  atomicAdd(records[record_index].digest[1], digest.y);
}

// Pieces come in order, so the first texel of all is found while its piece is here, and no later one replaces it.
void fetch() {
  if (gl_GlobalInvocationID.x > 0u) return;
  records[record_index].scanned = 1u;
  uint texel = 0xffffffffu - records[record_index].bad_from_end - first_texel;
  if (records[record_index].bad_from_end == 0u || texel >= texel_count) return;
  for (uint channel = 0u; channel < channels; ++channel)
    records[record_index].texel[channel] = channel_of(texel, channel);
}

void main() {
  if (stage == 0u) search();
  else fetch();
}
