// The random numbers of paths, by the param `sampling` of the passes that trace them.
#ifndef LIGHTLOOM_LIB_PATH_RANDOM
#define LIGHTLOOM_LIB_PATH_RANDOM

#include "lib/low_discrepancy.glsl"
#include "lib/random.glsl"

const uint kSamplingIndependent = 0u;
const uint kSamplingLowDiscrepancy = 1u;
layout(constant_id = 32) const uint sampling = 0u;

// Four words whose pairs yz and xw are even over paths and pixels. Other bounces, dimensions, frames and seeds, and the two
// pairs, have sequences of their own.
uvec4 even_bits(RandomKey key, uint bounce, uint dimension) {
  uint path_bits = key.paths > 1u ? uint(findMSB(key.paths - 1u)) + 1u : 0u;
  uint index = (morton(key.pixel) << path_bits) | key.path;
  // Of no pixel and no path: that of the sequence. The pairs are shuffled by independent seeds, so that it does no harm
  // that those of their scrambling are not.
  uvec4 seeds = random_bits(RandomKey(uvec2(0u), key.frame, key.seed, 0xffffu, 0u), bounce, dimension);
  seeds ^= seeds >> 16u;   // their lowest bits decide most
  uvec2 first = scrambled_point(index, seeds.xyz);
  uvec2 second = scrambled_point(index, uvec3(seeds.w, seeds.zy ^ 0x5bd1e995u));
  return uvec4(second.x, first, second.y);
}

// Four uniform numbers in [0, 1), independent of each other; with low discrepancy, of those of other pixels and paths
// only across frames.
vec4 path_random4(RandomKey key, uint bounce, uint dimension) {
  return sampling == kSamplingLowDiscrepancy ? uniform_floats(even_bits(key, bounce, dimension))
                                             : random4(key, bounce, dimension);
}

#endif
