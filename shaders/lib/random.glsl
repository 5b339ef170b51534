// Random numbers as a pure function of what they are for: no state, no texture, the same on every device.
#ifndef LIGHTLOOM_LIB_RANDOM
#define LIGHTLOOM_LIB_RANDOM

#include "lib/random_hash.glsl"

// What a group of four numbers decides at one vertex of a path; a new use needs a new constant, so that no two
// decisions share numbers.
const uint kDimensionLight = 0u;     // which hint, which punctual light, where on the sun's disc
const uint kDimensionScatter = 1u;   // which lobe, direction
const uint kDimensionEnvironment = 2u;   // direction from which light of the environment comes
const uint kDimensionFace = 3u;      // which face of an emissive voxel, where on it
const uint kDimensionCandidate = 4u; // the same, of a candidate for a reservoir
const uint kDimensionResample = 5u;  // which of two reservoirs' samples is kept
const uint kDimensionNeighbour = 6u; // which pixel's reservoir is reused

struct RandomKey {
  uvec2 pixel;   // below 65536 each
  uint frame;
  uint seed;
  uint path;     // below 65536
  uint paths;    // of the pixel in this frame; what low discrepancy spreads
};

// Uniform in [0, 1 - 2^-24]: 24 bits are what a float holds, so 1 is never reached.
vec4 uniform_floats(uvec4 bits) { return vec4(bits >> 8u) * (1.0 / 16777216.0); }

// Four random words; their last 8 bits are less random than the others. `bounce` and `dimension` are below 256.
uvec4 random_bits(RandomKey key, uint bounce, uint dimension) {
  uint place = key.pixel.x | (key.pixel.y << 16u);
  uint use = key.path | (bounce << 16u) | (dimension << 24u);
  // The hash spreads the highest bits of a word too little: seeds 2^31 apart would have numbers that are correlated by
  // 0.01. Folded they are not, and no two seeds fall together; those below 65536 stay what they are.
  uint seed = key.seed ^ (key.seed >> 16u);
  return random_hash(uvec4(place, key.frame, use, seed));
}

// Four independent uniform numbers in [0, 1).
vec4 random4(RandomKey key, uint bounce, uint dimension) { return uniform_floats(random_bits(key, bounce, dimension)); }

#endif
