// The Ward lobe at every pair of alphas (rows) and angle of view (columns), by sums over its samples and by an integral
// of its density over half vectors.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/sampling.glsl"
#include "lib/ward.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_samples;   // mean weight, largest weight, share above the horizon, values that are none
uniform writeonly image2D out_density;   // integral of the density, integral with rounded directions

layout(push_constant) uniform Params {
  float edge_alpha;   // above 0: rows are this alpha in both directions
  uint density;       // 0: not wanted
};

const uint kAlphas = 8u;
const float alphas[kAlphas] = float[kAlphas](0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0);
const uint kAngles = 7u;
// Cosines of 0, 45, 75, 85, 89, 89.9 and 89.99 degrees.
const float cosines[kAngles] = float[kAngles](1.0, 0.70710678, 0.25881905, 0.08715574, 0.017452406, 0.0017453284,
                                              0.00017453293);
const vec2 azimuths[3] = vec2[3](vec2(1.0, 0.0), vec2(0.70710678, 0.70710678), vec2(0.0, 1.0));

const uint kColumns = 128u;
const uint kRows = 48u;

struct SampleSums {
  float weights;
  float largest;
  float above;
  float bad;
};

SampleSums sum_samples(vec3 i, vec2 alpha) {
  SampleSums sums = SampleSums(0.0, 0.0, 0.0, 0.0);
  for (uint k = 0u; k < kColumns * kRows; ++k) {
    vec2 u = (vec2(k % kColumns, k / kColumns) + 0.5) / vec2(kColumns, kRows);
    vec3 o = ward_sample(i, u, alpha);
    float weight = ward_weight(i, o, alpha);
    float pdf = ward_pdf(i, o, alpha);
    if (!is_finite(o) || !is_finite(weight) || !is_finite(pdf) || !is_finite(ward_evaluate(i, o, alpha)) ||
        abs(length(o) - 1.0) > 1e-5) {
      sums.bad += 1.0;
      continue;
    }
    sums.weights += weight;
    sums.largest = max(sums.largest, weight);
    if (ward_reflects(i.z, o.z)) sums.above += 1.0;
  }
  return sums;
}

// Radius, in slopes over alpha, at which the half vectors of one azimuth send i to the horizon.
float horizon_radius(vec3 i, vec2 slope) {
  float towards = dot(i.xy, slope);
  float squared = dot(slope, slope);
  float root = sqrt(towards * towards + i.z * i.z * squared);
  return towards > 0.0 ? (towards + root) / (i.z * squared) : i.z / max(root - towards, 1e-30);
}

// Slopes at radius 1 of one azimuth as the sampling has it, and area of slopes over r dr d(azimuth).
vec3 slopes_of(float azimuth, vec2 a) {
  vec2 around = vec2(cos(azimuth), sin(azimuth));
  if (ward_sampling == kWardExact) return vec3(a * around, a.x * a.y);
  vec2 scaled = around / a;
  float squared = 1.0 / dot(scaled, scaled);
  return vec3(around * sqrt(squared), squared);
}

// d omega(o) = 4 (i . h) h.z^3 d slope. Along each azimuth up to where o is at the horizon.
vec2 integrate_density(vec3 i, vec2 alpha) {
  vec2 a = ward_alpha(alpha);
  vec2 sum = vec2(0.0);
  for (uint column = 0u; column < kColumns; ++column) {
    vec3 slopes = slopes_of(kPi * (2.0 * (float(column) + 0.5) / float(kColumns) - 1.0), a);
    vec2 slope = slopes.xy;
    float last = min(horizon_radius(i, slope), 6.0);
    for (uint row = 0u; row < kRows; ++row) {
      // Neither the integrand nor its derivative is 0 at the ends: a substitution makes it so.
      float s = (float(row) + 0.5) / float(kRows);
      float r = last * (s * s * s * (10.0 + s * (6.0 * s - 15.0)));
      float step_length = last * 30.0 * s * s * (1.0 - s) * (1.0 - s) / float(kRows);
      vec3 h = normalize(vec3(slope * r, 1.0));
      float cosine = dot(i, h);
      vec3 o = 2.0 * cosine * h - i;
      float area = 4.0 * cosine * h.z * h.z * h.z * slopes.z * r * step_length * (2.0 * kPi / float(kColumns));
      vec3 unrounded = 2.0 * cosine * h;
      sum += area * vec2(ward_pdf(i.z, o.z, unrounded, alpha), ward_pdf(i, o, alpha));
    }
  }
  return sum;
}

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_samples)))) return;
  vec2 alpha = edge_alpha > 0.0 ? vec2(edge_alpha) : vec2(alphas[place.y / 8], alphas[place.y % 8]);
  float z = cosines[place.x / 3];
  vec3 i = vec3(azimuths[place.x % 3] * sqrt((1.0 - z) * (1.0 + z)), z);
  SampleSums sums = sum_samples(i, alpha);
  float count = float(kColumns * kRows);
  imageStore(out_samples, place, vec4(sums.weights / count, sums.largest, sums.above / count, sums.bad));
  imageStore(out_density, place, density != 0u ? vec4(integrate_density(i, alpha), 0.0, 0.0) : vec4(0.0));
}
