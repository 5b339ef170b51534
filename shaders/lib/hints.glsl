// Next event estimation by hints: points on the emissive triangles that the host draws each frame (paper, section 2.2).
// Who calls looks for what is in the way.
//
// Rays that meet triangles find just what the hints lie on. Emissive voxels are more than the triangles: what MIS gives
// to rays through voxels is light of the voxels, what it gives to the hints light of the triangles. The two differ by the
// area that voxels add, and so does the sum with the shares.
#ifndef LIGHTLOOM_LIB_HINTS
#define LIGHTLOOM_LIB_HINTS

#include "lib/mis.glsl"
#include "lib/path_vertex.glsl"
#include "lib/scene.glsl"

// Density with which a hint is drawn at a point of an emissive surface, per solid angle from `distance_squared` away.
float hint_pdf(uint emission, float distance_squared, float cosine) {
  return lights.emitters[emission].surface.x * distance_squared / max(cosine, 1e-6);
}

// Picks a hint uniformly by `u`; false where there is none.
bool pick_hint(float u, out Hint hint) {
  uint count = frame.counts.z;
  if (count == 0u) return false;
  hint = lights.hints[min(uint(u * float(count)), count - 1u)];
  return true;
}

// Light of a hint that emits `radiance`. Closer than `closest` [m] the light touches the surface, and the geometry term
// has no meaning.
LightSample hint_sample(PathVertex vertex, Hint hint, vec3 radiance, float closest) {
  uint emission = uint(hint.position.w);
  vec3 path = hint.position.xyz - vertex.position;
  float distance_squared = dot(path, path);
  if (distance_squared < closest * closest) return kNoLightSample;
  vec3 direction = path * inversesqrt(distance_squared);
  float cosine = -dot(hint.normal.xyz, direction);
  if (lights.emissions[emission].sides.x > 0.5) cosine = abs(cosine);
  if (cosine <= 1e-6) return kNoLightSample;
  PerLobe reflected = reflectance_towards(vertex, direction);
  if (is_black(reflected)) return kNoLightSample;
  float weight =
      light_sample_weight(hint_pdf(emission, distance_squared, cosine), scatter_pdf(vertex, direction));
  return LightSample(direction, scaled(reflected, radiance * weight));
}

// Density [sr^-1] that a hint would have had where a scattered ray met an emissive surface, `distance_squared` [m^2] away.
float hint_hit_pdf(uint emission, vec3 surface_normal, vec3 direction, float distance_squared) {
  float cosine = abs(dot(surface_normal, direction));
  return hint_pdf(emission, distance_squared, cosine);
}

#endif
