// A whole surface, base and lobe, at every pair of alphas (rows) and angle of view (columns): sums over a grid of
// samples.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/bsdf.glsl"
#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_samples;   // mean weight, largest weight, least density, values that are none

layout(push_constant) uniform Params {
  float metallic;
  float edge_alpha;   // above 0: rows are this alpha in both directions
  uint heights;       // that samples have
};

const uint kAlphas = 8u;
const float alphas[kAlphas] = float[kAlphas](0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0);
const uint kAngles = 7u;
const float cosines[kAngles] = float[kAngles](1.0, 0.70710678, 0.25881905, 0.08715574, 0.017452406, 0.0017453284,
                                              0.00017453293);
const uint kPicks = 50u;   // of the lobe: its probability is 1/25 at least, head on
const uint kAzimuths = 8u;

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_samples)))) return;
  vec2 alpha = edge_alpha > 0.0 ? vec2(edge_alpha) : vec2(alphas[place.y / 8], alphas[place.y % 8]);
  float z = cosines[place.x];
  vec3 i = vec3(vec2(0.6, 0.8) * sqrt((1.0 - z) * (1.0 + z)), z);
  Bsdf bsdf = Bsdf(vec3(1.0), metallic, 0.04, 1.0, alpha);
  float sum = 0.0, largest = 0.0, bad = 0.0, least = 1e30;
  for (uint k = 0u; k < kPicks * heights * kAzimuths; ++k) {
    vec3 u = (vec3(k % kPicks, k / (kPicks * kAzimuths), (k / kPicks) % kAzimuths) + 0.5) / vec3(kPicks, heights, kAzimuths);
    BsdfSample s = bsdf_sample(bsdf, i, u);
    vec3 value = bsdf_evaluate(bsdf, i, s.direction);
    if (!is_finite(s.weight) || !is_finite(s.pdf) || !is_finite(value) || any(lessThan(s.weight, vec3(0.0)))) {
      bad += 1.0;
      continue;
    }
    sum += s.weight.x;
    largest = max(largest, s.weight.x);
    if (s.weight.x > 0.0 && !s.mirror) least = min(least, s.pdf);
  }
  imageStore(out_samples, place, vec4(sum / float(kPicks * heights * kAzimuths), largest, least, bad));
}
