// What light samplers return at the ends of their random numbers: the texels of a row are all combinations of 0, a half
// and the largest number below 1, rows are cases.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/environment_light.glsl"
#include "lib/punctual.glsl"
#include "lib/random.glsl"
#include "lib/sun.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_directions;   // direction; density [sr^-1]
uniform writeonly image2D out_weights;      // case-dependent: see main

layout(push_constant) uniform Params {
  uint sampler_kind;   // 0 cosine, 1 Ward, 2 cone, 3 environment, 4 punctual choice, 5 sun of the scene
};

const float ends[3] = float[3](0.0, 0.5, 1.0 - 1.0 / 16777216.0);
const float alphas[8] = float[8](0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0);
const float drops[8] = float[8](0.0, 1e-12, 1.0825e-5, 1e-3, 0.1, 0.5, 0.9, 1.0);

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_directions)))) return;
  vec4 u = vec4(ends[place.x % 3], ends[(place.x / 3) % 3], ends[(place.x / 9) % 3], ends[(place.x / 27) % 3]);
  vec3 direction = vec3(0.0, 0.0, 1.0);
  float pdf = 1.0;
  vec4 extra = vec4(0.0);
  if (sampler_kind == 0u) {
    direction = sample_cosine_hemisphere(u.xy);
    pdf = direction.z / kPi;
  } else if (sampler_kind == 1u) {
    vec2 alpha = vec2(alphas[place.y / 8], alphas[place.y % 8]);
    vec3 i = normalize(vec3(0.48, 0.64, 0.6));
    vec3 h = ward_sample_half_vector(u.xy, alpha);
    direction = ward_sample(i, u.xy, alpha);
    pdf = ward_pdf(i, direction, alpha);
    extra = vec4(h, ward_weight(i, direction, alpha));
  } else if (sampler_kind == 2u) {
    vec3 axis = normalize(vec3(1.0, -2.0, 0.5));
    direction = sample_cone(axis, drops[place.y], u.xy);
    vec3 off = direction - axis;
    extra = vec4(0.5 * dot(off, off), drops[place.y], 0.0, 0.0);
  } else if (sampler_kind == 3u) {
    bool found = sample_environment(u, direction, pdf);
    extra = vec4(found ? 1.0 : 0.0, environment_radiance(direction));
  } else if (sampler_kind == 4u) {
    PunctualLight light;
    bool found = pick_punctual(u.x, light);
    extra = vec4(found ? 1.0 : 0.0, light.intensity.rgb);
  } else {
    direction = sample_cone(-frame.sun_direction.xyz, sun_drop(), u.xy);
    pdf = sun_pdf(sun_drop());
    extra = vec4(sun_drop(), sun_radiance(sun_drop()));
  }
  imageStore(out_directions, place, vec4(direction, pdf));
  imageStore(out_weights, place, extra);
}
