// Pairs of numbers that fill the unit square evenly over the paths of a pixel and over the pixels around it: the points
// of a (0, 2)-sequence in Morton order of the pixels (Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte
// Carlo Sampling Error via Hierarchical Ordering of Pixels"), shuffled and scrambled by hashes in the way of Owen
// (Burley 2020, "Practical Hash-based Owen Scrambling").
//
// Among aligned blocks of 2^a pixels in Morton order with 2^b paths each, every elementary interval of area 2^-(a + b)
// has one point. Each point alone is uniform.
#ifndef LIGHTLOOM_LIB_LOW_DISCREPANCY
#define LIGHTLOOM_LIB_LOW_DISCREPANCY

// Spreads the low 16 bits to the even places.
uint spread_bits(uint x) {
  x &= 0xffffu;
  x = (x | (x << 8u)) & 0x00ff00ffu;
  x = (x | (x << 4u)) & 0x0f0f0f0fu;
  x = (x | (x << 2u)) & 0x33333333u;
  return (x | (x << 1u)) & 0x55555555u;
}

uint morton(uvec2 pixel) { return spread_bits(pixel.x) | (spread_bits(pixel.y) << 1u); }

// Laine and Karras 2011, with Burley's constants: a permutation of words in which bit k depends on bits 0 to k alone. On
// reversed words that is Owen's scrambling.
uint nested_permutation(uint x, uint seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

// Sobol's second dimension of a number, reversed: bit k is the parity of the bits j of x for which "j over k" is odd.
uint pascal_transform(uint x) {
  x ^= (x & 0xaaaaaaaau) >> 1u;
  x ^= (x & 0xccccccccu) >> 2u;
  x ^= (x & 0xf0f0f0f0u) >> 4u;
  x ^= (x & 0xff00ff00u) >> 8u;
  return x ^ (x >> 16u);
}

// Point `index` of the sequence that the seeds choose; x: of the shuffling, yz: of the scrambling of the two coordinates.
uvec2 scrambled_point(uint index, uvec3 seeds) {
  uint shuffled = bitfieldReverse(nested_permutation(bitfieldReverse(index), seeds.x));
  return uvec2(bitfieldReverse(nested_permutation(shuffled, seeds.y)),
               bitfieldReverse(nested_permutation(pascal_transform(shuffled), seeds.z)));
}

#endif
