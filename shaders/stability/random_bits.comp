// The 128 bits of many keys: the words of the key grow along x and y by their steps from where they begin.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly uimage2D out_bits;

// Words in this order: pixel x, pixel y, frame, path, bounce, dimension, seed. The upper halves of two are given apart,
// since a graph's numbers are signed.
const uint kWords = 7u;

layout(push_constant) uniform Params {
  uint pixel_x;
  uint pixel_y;
  uint frame_low;
  uint frame_high;   // times 65536
  uint path;
  uint bounce;
  uint dimension;
  uint seed_low;
  uint seed_high;    // times 65536
  uint along_x;      // the word that grows along x
  uint along_y;
  uint step_x;
  uint step_y;
};

void main() {
  uvec2 place = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(place, uvec2(imageSize(out_bits))))) return;
  uint words[kWords] = uint[kWords](pixel_x, pixel_y, frame_low | (frame_high << 16u), path, bounce, dimension,
                                    seed_low | (seed_high << 16u));
  words[along_x] += place.x * step_x;
  words[along_y] += place.y * step_y;
  RandomKey key = RandomKey(uvec2(words[0], words[1]), words[2], words[6], words[3], 1u);
  imageStore(out_bits, ivec2(place), random_bits(key, words[4], words[5]));
}
