// Next event estimation by hints: points on the emissive triangles that the host draws each frame (paper, section 2.2).
//
// Rays meet emissive voxels, which are more than the triangles: what MIS gives to the rays is light of the voxels, what
// it gives to the hints light of the triangles. The two differ by the area that voxels add, and so does the sum with
// the shares.
#ifndef LIGHTLOOM_LIB_HINTS
#define LIGHTLOOM_LIB_HINTS

#include "lib/grid.glsl"
#include "lib/light_visibility.glsl"
#include "lib/mis.glsl"
#include "lib/path_vertex.glsl"
#include "lib/scene.glsl"

// Density with which a hint is drawn at a point of an emissive surface, per solid angle from `distance_squared` away.
float hint_pdf(uint emission, float distance_squared, float cosine) {
  return lights.emitters[emission].surface.x * distance_squared / max(cosine, 1e-6);
}

// Light of one hint, picked uniformly by `u`.
PerLobe hint_light(Grid grid, texture3D distance_field, texture3D material, PathVertex vertex, float u) {
  uint count = frame.counts.z;
  if (count == 0u) return kNoLight;
  Hint hint = lights.hints[min(uint(u * float(count)), count - 1u)];
  uint emission = uint(hint.position.w);
  vec3 path = hint.position.xyz - vertex.position;
  float distance_squared = dot(path, path);
  // Closer than this the light touches the surface, and the geometry term has no meaning.
  if (distance_squared < 1e-8 * grid.voxel_size * grid.voxel_size) return kNoLight;
  vec3 direction = path * inversesqrt(distance_squared);
  float cosine = -dot(hint.normal.xyz, direction);
  if (lights.emissions[emission].sides.x > 0.5) cosine = abs(cosine);
  if (cosine <= 1e-6) return kNoLight;
  PerLobe reflected = reflectance_towards(vertex, direction);
  if (is_black(reflected)) return kNoLight;
  vec3 target = world_to_grid(grid, hint.position.xyz);
  if (!light_visible(distance_field, material, vertex.origin, target, emission)) return kNoLight;
  float weight =
      light_sample_weight(hint_pdf(emission, distance_squared, cosine), scatter_pdf(vertex, direction));
  return scaled(reflected, lights.emissions[emission].radiance.rgb * weight);
}

// Density [sr^-1] that a hint would have had where a scattered ray met an emissive voxel, `distance_squared` [m^2] away.
float hint_hit_pdf(uint emission, vec3 voxel_normal, vec3 direction, float distance_squared) {
  float cosine = abs(dot(voxel_normal, direction));
  return hint_pdf(emission, distance_squared, cosine);
}

#endif
