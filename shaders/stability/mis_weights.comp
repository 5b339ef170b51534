// Shares of two strategies whose densities are 10^-30 to 10^30: column and row are the exponents.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_shares;   // balance of one and of the other, power of one and of the other

float power_of_ten(int exponent) {
  float result = 1.0;
  for (int k = 0; k < abs(exponent); ++k) result *= 10.0;
  return exponent < 0 ? 1.0 / result : result;
}

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_shares)))) return;
  float a = power_of_ten(place.x - 30), b = power_of_ten(place.y - 30);
  imageStore(out_shares, place, vec4(balance_weight(a, b), balance_weight(b, a), power_weight(a, b), power_weight(b, a)));
}
