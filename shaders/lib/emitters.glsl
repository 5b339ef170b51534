// Light of emissive voxels: next event estimation by hints (hints.glsl) or by the faces that rays meet, and what a ray
// that meets such a voxel adds.
//
// By faces, both strategies see one and the same set of emitters with one density, so that they agree whatever the
// shares: a sample counts if the first voxel on its way is the one that was drawn, and a ray that enters a voxel knows
// by the same weights how likely that face was to be drawn.
#ifndef LIGHTLOOM_LIB_EMITTERS
#define LIGHTLOOM_LIB_EMITTERS

#include "lib/face_points.glsl"
#include "lib/hints.glsl"
#include "lib/light_visibility.glsl"
#include "lib/random.glsl"

const uint kNeeHints = 0u;
const uint kNeeVoxelFaces = 1u;
layout(constant_id = 24) const uint nee = 0u;

// Is a point on an emissive face the first that a ray to it meets? A sphere march may notice the voxel as late as when it
// leaves it.
bool face_visible(texture3D distance_field, PathVertex vertex, FacePoint point) {
  vec4 way = way_to_face(vertex, point);
  MarchHit hit = march_grid(distance_field, vertex.origin, way.xyz, way.w + 2.0);
  return hit.hit && hit.voxel == point.voxel;
}

// A point on one face, drawn by weight.
PerLobe face_light(Grid grid, texture3D distance_field, texture3D normals, texture3D materials, PathVertex vertex,
                   uvec4 bits) {
  FacePoint point = draw_face_point(bits);
  PerLobe light = face_point_light(grid, normals, materials, vertex, point, 1.0);
  return is_black(light) || !face_visible(distance_field, vertex, point) ? kNoLight : light;
}

// Density [sr^-1] with which face_light draws the direction of a ray that hit an emissive voxel.
float face_hit_pdf(texture3D albedo, MarchHit hit, VoxelSurface surface, vec3 origin, vec3 direction) {
  float probability = face_probability(albedo, hit.voxel, face_index(hit.face), surface.emission, surface.normal);
  return face_solid_angle_pdf(probability, entry_distance(hit, origin, direction), -dot(vec3(hit.face), direction));
}

// Light of one hint, picked uniformly by `u`.
PerLobe hint_light(Grid grid, texture3D distance_field, texture3D materials, PathVertex vertex, float u) {
  Hint hint;
  if (!pick_hint(u, hint)) return kNoLight;
  uint emission = uint(hint.position.w);
  PerLobe light = hint_sample(vertex, hint, lights.emissions[emission].radiance.rgb, 1e-4 * grid.voxel_size).light;
  vec3 target = world_to_grid(grid, hint.position.xyz);
  if (is_black(light) || !light_visible(distance_field, materials, vertex.origin, target, emission)) return kNoLight;
  return light;
}

// One sample of the emissive surfaces, reflected by each lobe.
PerLobe emitter_light(Grid grid, texture3D distance_field, texture3D normals, texture3D materials, PathVertex vertex,
                      RandomKey key, uint bounce, float hint_random) {
  if (!has_emissive || !kSampleLights) return kNoLight;
  if (nee == kNeeHints) return hint_light(grid, distance_field, materials, vertex, hint_random);
  uvec4 bits = random_bits(key, bounce, kDimensionFace);
  return face_light(grid, distance_field, normals, materials, vertex, bits);
}

// Radiance that a scattered ray adds by the emissive voxel that it met: `from` where it left a surface, `at` where it
// met the voxel's [m], `origin` as it was marched from [grid units]. `draws`: of next event estimation there, one but for
// reservoirs.
vec3 emitter_hit(Grid grid, texture3D albedo, MarchHit hit, VoxelSurface surface, vec3 from, vec3 at, vec3 origin,
                 vec3 direction, BsdfSample scatter, float draws) {
  if (!has_emissive || surface.emission == 0u || !emits_along(surface.emission, surface.normal, direction))
    return vec3(0.0);
  vec3 path = at - from;
  float pdf = nee == kNeeHints ? hint_hit_pdf(surface.emission, surface.normal, direction, dot(path, path))
                               : face_hit_pdf(albedo, hit, surface, origin, direction);
  return voxel_radiance(grid, surface.emission) * light_hit_weight(scatter, draws * pdf);
}

#endif
