// Next event estimation at a vertex of a path: one sample of the emissive surfaces, one of the sun, one punctual light.
#ifndef LIGHTLOOM_LIB_LIGHTS
#define LIGHTLOOM_LIB_LIGHTS

#include "lib/bsdf.glsl"
#include "lib/grid.glsl"
#include "lib/march.glsl"
#include "lib/sampling.glsl"
#include "lib/scene.glsl"

// Where a path meets a surface.
struct PathVertex {
  vec3 position;           // [m]
  vec3 origin;             // where rays leave: clear of the surface's own voxels [grid units]
  vec3 geometric_normal;   // unit, on the side that the path came from
  LocalFrame basis;        // around the shading normal
  vec3 incoming;           // unit, towards where the path came from, in `basis`
  Bsdf bsdf;
};

// A shadow ray may end this far from its target: there the target's own voxels begin.
const float kLightReach = 1.7320508;   // sqrt(3) voxels

// Is nothing between the vertex and a point on a light? Voxels of the same emissive material are the light itself.
bool light_visible(texture3D distance_field, texture3D material, vec3 origin, vec3 target, uint emission) {
  vec3 path = target - origin;
  float path_length = length(path);
  if (path_length <= kLightReach) return true;
  MarchHit hit = march(distance_field, origin, path / path_length, path_length - kLightReach);
  if (!hit.hit) return true;
  return emission > 0u && uint(round(texelFetch(material, hit.voxel, 0).a * 255.0)) == emission;
}

// Density with which a hint is drawn at a point of an emissive surface, per solid angle from `distance_squared` away.
float hint_pdf(uint emission, float distance_squared, float cosine) {
  return lights.emissions[emission].radiance.w * distance_squared / max(cosine, 1e-6);
}

// Light of one hint, picked uniformly by `u`. The balance heuristic shares it with rays that hit the surface by chance:
// f cos L / p_hint * p_hint / (p_hint + p_bsdf).
vec3 hint_light(Grid grid, texture3D distance_field, texture3D material, PathVertex vertex, float u) {
  uint count = frame.counts.z;
  if (!has_emissive || count == 0u) return vec3(0.0);
  Hint hint = lights.hints[min(uint(u * float(count)), count - 1u)];
  uint emission = uint(hint.position.w);
  vec3 path = hint.position.xyz - vertex.position;
  float distance_squared = dot(path, path);
  // Closer than this the light touches the surface, and the geometry term has no meaning.
  if (distance_squared < 1e-8 * grid.voxel_size * grid.voxel_size) return vec3(0.0);
  vec3 direction = path * inversesqrt(distance_squared);
  float cosine = -dot(hint.normal.xyz, direction);
  if (lights.emissions[emission].sides.x > 0.5) cosine = abs(cosine);
  vec3 o = to_local(vertex.basis, direction);
  if (cosine <= 1e-6 || dot(direction, vertex.geometric_normal) <= 0.0) return vec3(0.0);
  vec3 reflected = bsdf_evaluate(vertex.bsdf, vertex.incoming, o) * max(o.z, 0.0);
  if (reflected == vec3(0.0)) return vec3(0.0);
  vec3 target = world_to_grid(grid, hint.position.xyz);
  if (!light_visible(distance_field, material, vertex.origin, target, emission)) return vec3(0.0);
  float density = hint_pdf(emission, distance_squared, cosine) + bsdf_pdf(vertex.bsdf, vertex.incoming, o);
  return reflected * lights.emissions[emission].radiance.rgb / density;
}

// For a small disc few digits are left of this, but only the width of penumbrae feels it: the disc's solid angle
// cancels from sun_light.
float sun_one_minus_cosine() { return max(0.0, 1.0 - frame.sun_direction.w); }

// Radiance of the sun's disc times its solid angle, for a direction sampled uniformly on it: the irradiance on a
// surface that faces the sun is the integral of the cosine over the disc, which is solid angle times (1 + cos) / 2.
vec3 sun_intensity() { return frame.sun_irradiance.rgb * (2.0 / (1.0 + frame.sun_direction.w)); }

vec3 sun_light(texture3D distance_field, PathVertex vertex, vec2 u) {
  if (!has_sun) return vec3(0.0);
  vec3 direction = -frame.sun_direction.xyz;
  if (sun_one_minus_cosine() > 0.0) direction = sample_cone(direction, sun_one_minus_cosine(), u);
  vec3 o = to_local(vertex.basis, direction);
  if (dot(direction, vertex.geometric_normal) <= 0.0) return vec3(0.0);
  vec3 reflected = bsdf_evaluate(vertex.bsdf, vertex.incoming, o) * max(o.z, 0.0);
  if (reflected == vec3(0.0) || march(distance_field, vertex.origin, direction, 1e30).hit) return vec3(0.0);
  return reflected * sun_intensity();
}

// What a ray that leaves the scene sees of the sun's disc. Only mirrors ask: for all else sun_light has counted it.
vec3 sun_disc_radiance(vec3 direction) {
  float drop = sun_one_minus_cosine();
  if (!has_sun || drop <= 0.0 || dot(direction, -frame.sun_direction.xyz) < frame.sun_direction.w) return vec3(0.0);
  return sun_intensity() / (6.28318530717959 * drop);
}

// Falloff of a punctual light (KHR_lights_punctual), as irradiance per intensity.
float punctual_attenuation(PunctualLight light, vec3 to_light, float distance_squared) {
  uint type = uint(light.direction.w);
  if (type == kPunctualDirectional) return 1.0;
  float attenuation = 1.0 / distance_squared;
  float range = light.position.w;
  if (range > 0.0) {
    float q = distance_squared / (range * range);
    attenuation *= clamp(1.0 - q * q, 0.0, 1.0);
  }
  if (type == kPunctualSpot) {
    float angular = clamp(dot(light.direction.xyz, -to_light) * light.cone.x + light.cone.y, 0.0, 1.0);
    attenuation *= angular * angular;
  }
  return attenuation;
}

// Light of one punctual light, picked uniformly by `u`, times their number.
vec3 punctual_light(Grid grid, texture3D distance_field, texture3D material, PathVertex vertex, float u) {
  uint count = frame.counts.w;
  if (!has_punctual || count == 0u) return vec3(0.0);
  PunctualLight light = lights.punctual[min(uint(u * float(count)), count - 1u)];
  bool directional = uint(light.direction.w) == kPunctualDirectional;
  vec3 path = directional ? -light.direction.xyz : light.position.xyz - vertex.position;
  float distance_squared = max(dot(path, path), 1e-8 * grid.voxel_size * grid.voxel_size);
  vec3 direction = path * inversesqrt(distance_squared);
  vec3 o = to_local(vertex.basis, direction);
  if (dot(direction, vertex.geometric_normal) <= 0.0) return vec3(0.0);
  vec3 reflected = bsdf_evaluate(vertex.bsdf, vertex.incoming, o) * max(o.z, 0.0);
  vec3 arriving = light.intensity.rgb * punctual_attenuation(light, direction, distance_squared) * float(count);
  if (reflected * arriving == vec3(0.0)) return vec3(0.0);
  vec3 target = world_to_grid(grid, light.position.xyz);
  bool visible = directional ? !march(distance_field, vertex.origin, direction, 1e30).hit
                             : light_visible(distance_field, material, vertex.origin, target, 0u);
  return visible ? reflected * arriving : vec3(0.0);
}

// Direct light reflected at a vertex. `u`: four uniform numbers.
vec3 direct_light(Grid grid, texture3D distance_field, texture3D material, PathVertex vertex, vec4 u) {
  return hint_light(grid, distance_field, material, vertex, u.x) + sun_light(distance_field, vertex, u.yz) +
         punctual_light(grid, distance_field, material, vertex, u.w);
}

#endif
