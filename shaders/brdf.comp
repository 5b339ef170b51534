// The Ward lobe by itself, for the command `brdf`: values of pairs of directions, samples, or directional albedo. Host
// side: framework/run/brdf.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/ward.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint quantity = 0u;
const uint kEvaluate = 0u;
const uint kSample = 1u;
const uint kAlbedo = 2u;

layout(push_constant) uniform Params {
  float alpha_x;
  float alpha_y;
  uint invocations;
  uint columns;   // of azimuths that an albedo is summed over
  uint rows;      // of radii, each
};

struct Query {
  vec4 i;   // unit, up
  vec4 o;   // evaluate: unit; sample: two uniform numbers in [0, 1)
  vec4 h;   // evaluate: i + o, of directions that were not rounded
};

struct Answer {
  vec4 direction;   // o; w: 1 if the path tracer takes the lobe for a mirror
  vec4 values;      // f [sr^-1], pdf [sr^-1], f cos / pdf; albedo: share of one column
};

layout(std430) readonly buffer Queries { Query queries[]; };
layout(std430) writeonly buffer Answers { Answer answers[]; };

vec4 values_of(vec3 i, vec3 o, vec3 h, vec2 alpha) {
  return vec4(ward_evaluate(i.z, o.z, h, alpha), ward_pdf(i.z, o.z, h, alpha), ward_weight(i.z, o.z, h, alpha), 0.0);
}

// Radius, in slopes over alpha, at which the half vectors of one azimuth send i to the horizon: the larger root of
// i.z |s|^2 r^2 - 2 (i . s) r - i.z = 0 for the slope s of radius 1.
float horizon_radius(vec3 i, vec2 slope) {
  float towards = dot(i.xy, slope);
  float root = sqrt(towards * towards + i.z * i.z * dot(slope, slope));
  return towards > 0.0 ? (towards + root) / (i.z * dot(slope, slope)) : i.z / (root - towards);
}

// Mean weight over the half vectors of one azimuth, which reach the radius r with density 2 r exp(-r^2). The substitution
// r = last s^3 (10 - 15 s + 6 s^2) makes the integrand and its derivative 0 at both ends, where the midpoint rule would
// else lose its order.
float albedo_of_azimuth(vec3 i, float phi, vec2 alpha) {
  vec2 slope = ward_alpha(alpha) * vec2(cos(phi), sin(phi));
  float last = min(horizon_radius(i, slope), 6.0);   // exp(-36) is nothing
  float sum = 0.0;
  for (uint row = 0u; row < rows; ++row) {
    float s = (float(row) + 0.5) / float(rows);
    float r = last * (s * s * s * (10.0 + s * (6.0 * s - 15.0)));
    float step_length = last * 30.0 * s * s * (1.0 - s) * (1.0 - s);
    vec3 h = normalize(vec3(slope * r, 1.0));
    vec3 o = 2.0 * dot(i, h) * h - i;
    sum += ward_weight(i, o, alpha) * 2.0 * r * exp(-r * r) * step_length;
  }
  return sum / float(rows);
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= invocations) return;
  vec2 alpha = vec2(alpha_x, alpha_y);
  float mirror = ward_is_mirror(alpha) ? 1.0 : 0.0;
  if (quantity == kEvaluate) {
    Query query = queries[index];
    answers[index] = Answer(vec4(query.o.xyz, mirror), values_of(query.i.xyz, query.o.xyz, query.h.xyz, alpha));
  } else if (quantity == kSample) {
    vec3 i = queries[index].i.xyz;
    vec3 o = i.z > kWardMinimumCosine ? ward_sample(i, queries[index].o.xy, alpha) : vec3(0.0, 0.0, -1.0);
    answers[index] = Answer(vec4(o, mirror), values_of(i, o, i + o, alpha));
  } else {
    vec3 i = queries[index / columns].i.xyz;
    float phi = kPi * ((2.0 * float(index % columns) + 1.0) / float(columns) - 1.0);
    float share = i.z > kWardMinimumCosine ? albedo_of_azimuth(i, phi, alpha) : 0.0;
    answers[index] = Answer(vec4(0.0), vec4(share, 0.0, 0.0, 0.0));
  }
}
