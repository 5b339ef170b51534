// Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011, with a key of
// 0, in place of shaders/lib/random_hash.glsl: another family of generators, for comparison.
#ifndef LIGHTLOOM_LIB_RANDOM_HASH
#define LIGHTLOOM_LIB_RANDOM_HASH

uvec4 random_hash(uvec4 v) {
  uvec2 key = uvec2(0u);
  for (uint round = 0u; round < 10u; ++round) {
    uvec2 high, low;
    umulExtended(v.xz, uvec2(0xD2511F53u, 0xCD9E8D57u), high, low);
    v = uvec4(high.y ^ v.y ^ key.x, low.y, high.x ^ v.w ^ key.y, low.x);
    key += uvec2(0x9E3779B9u, 0xBB67AE85u);
  }
  return v;
}

#endif
