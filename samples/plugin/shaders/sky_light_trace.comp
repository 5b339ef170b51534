// Ambient light by rays to the sky, and the sun's with its shadow. Shares Lightloom's functions under lib/.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/environment.glsl"
#include "lib/grid.glsl"
#include "lib/march.glsl"
#include "lib/random.glsl"
#include "lib/ray_start.glsl"
#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_geometric_normal;
uniform texture2D surface_emission;
uniform texture3D distance;
uniform writeonly image2D out_radiance;
uniform writeonly image2D out_diffuse;
uniform writeonly image2D out_specular;

layout(push_constant) uniform Params { uint paths; };

const float kPi = 3.14159265358979;

bool reaches_sky(vec3 origin, vec3 direction) { return !march_ray(distance, origin, direction, kFarAway).hit; }

// Cosine-distributed around the normal, so that the mean of what rays find is irradiance / pi.
vec3 ray_direction(LocalFrame around, vec2 u) {
  float radius = sqrt(u.x);
  return to_world(around, vec3(radius * cos(2.0 * kPi * u.y), radius * sin(2.0 * kPi * u.y), sqrt(1.0 - u.x)));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(surface_position, 0)))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  bool lit = position.w > 0.0 && texelFetch(surface_emission, pixel, 0).w < 0.5;
  vec3 light = vec3(0.0);
  if (lit) {
    Grid grid = scene_grid(textureSize(distance, 0));
    vec3 normal = normalize(texelFetch(surface_normal, pixel, 0).xyz);
    vec3 face_normal = normalize(texelFetch(surface_geometric_normal, pixel, 0).xyz);
    vec3 origin = world_to_grid(grid, position.xyz) + face_normal * start_offset(face_normal);
    LocalFrame around = make_frame(normal, vec3(normal.y, normal.z, normal.x));
    RandomKey key = RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, paths);
    for (key.path = 0u; key.path < paths; ++key.path) {
      vec3 direction = ray_direction(around, random4(key, 0u, kDimensionScatter).xy);
      if (dot(direction, face_normal) > 0.0 && reaches_sky(origin, direction)) light += environment_radiance(direction);
    }
    light /= float(paths);
    vec3 to_sun = -frame.sun_direction.xyz;
    float cosine = dot(normal, to_sun);
    if (has_sun && cosine > 0.0 && dot(to_sun, face_normal) > 0.0 && reaches_sky(origin, to_sun))
      light += frame.sun_irradiance.rgb * (cosine / kPi);
  }
  vec4 result = vec4(light, lit ? 1.0 : 0.0);
  imageStore(out_radiance, pixel, result);
  imageStore(out_diffuse, pixel, result);
  imageStore(out_specular, pixel, vec4(0.0, 0.0, 0.0, result.a));
}
