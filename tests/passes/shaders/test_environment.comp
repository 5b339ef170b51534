// What lib/environment.glsl samples, and what it says of given directions.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/environment.glsl"
#include "lib/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_sampled;     // direction, its pdf
uniform writeonly image2D out_looked_up;   // pdf of that direction, luminance there, 1 if there was a sample
uniform writeonly image2D out_even;        // a direction spread evenly over the sphere, its pdf
uniform writeonly image2D out_place;       // texture coordinates of that direction

void main() {
  ivec2 size = imageSize(out_sampled);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec3 direction;
  float pdf;
  vec4 u = random4(RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, 1u), 0u, 7u);
  bool found = sample_environment(u, direction, pdf);
  imageStore(out_sampled, pixel, vec4(direction, pdf));
  vec3 radiance = environment_radiance(direction);
  imageStore(out_looked_up, pixel, vec4(environment_pdf(direction), radiance.g, found ? 1.0 : 0.0, 0.0));

  // Even in longitude and in the cosine of the polar angle; the corners are the poles and the seam themselves.
  vec2 at = vec2(pixel) / vec2(size - 1);
  float y = 1.0 - 2.0 * at.y;
  float across = sqrt(max(0.0, 1.0 - y * y));
  float longitude = 3.14159265358979 * (2.0 * at.x - 1.0);
  vec3 even = vec3(across * cos(longitude), y, across * sin(longitude));
  imageStore(out_even, pixel, vec4(even, environment_pdf(even)));
  imageStore(out_place, pixel, vec4(environment_texcoord(even), 0.0, 0.0));
}
