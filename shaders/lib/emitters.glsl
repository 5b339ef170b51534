// Light of emissive voxels: next event estimation by hints (hints.glsl) or by the faces that rays meet, and what a ray
// that meets such a voxel adds.
//
// By faces, both strategies see one and the same set of emitters with one density, so that they agree whatever the
// shares: a sample counts if the first voxel on its way is the one that was drawn, and a ray that enters a voxel knows
// by the same weights how likely that face was to be drawn.
#ifndef LIGHTLOOM_LIB_EMITTERS
#define LIGHTLOOM_LIB_EMITTERS

#include "lib/emissive_faces.glsl"
#include "lib/grid.glsl"
#include "lib/hints.glsl"
#include "lib/light_visibility.glsl"
#include "lib/random.glsl"
#include "lib/voxel_bits.glsl"

const uint kNeeHints = 0u;
const uint kNeeVoxelFaces = 1u;
layout(constant_id = 24) const uint nee = 0u;

const uint kEmitterVoxels = 0u;
const uint kEmitterSurface = 1u;
layout(constant_id = 25) const uint emitter_area = 0u;

uniform utexture2D faces;
uniform utexture2D power;

// Radiance of the voxels of an emission entry. By the surface's area it is such that all of them have the power of its
// triangles, however coarse the grid; no more than four times the real one, so that what little may peep out of other
// surfaces is not blinding.
vec3 voxel_radiance(Grid grid, uint emission) {
  vec3 radiance = lights.emissions[emission].radiance.rgb;
  if (emitter_area == kEmitterVoxels) return radiance;
  float in_voxels = float(texelFetch(power, ivec2(emission, 0), 0).r) / kFacePowerUnit;
  float surface_area = lights.emitters[emission].surface.y * (1.0 + lights.emissions[emission].sides.x);
  float in_surface = surface_area / (grid.voxel_size * grid.voxel_size);
  return radiance * (in_voxels > 0.0 ? min(in_surface / in_voxels, 4.0) : 1.0);
}

// Does a one-sided emitter send light along a direction, given the normal of its voxel?
bool emits_along(uint emission, vec3 voxel_normal, vec3 direction) {
  return lights.emissions[emission].sides.x > 0.5 || dot(voxel_normal, direction) < 0.0;
}

// Density per solid angle [sr^-1] of a point on a face that is drawn with `probability`, a unit square, `t` voxels away.
float face_solid_angle_pdf(float probability, float t, float cosine) {
  return t > 1e-4 && cosine > 1e-6 ? probability * t * t / cosine : 0.0;
}

// First face whose cumulative weight is above `target`.
uint find_face(uint count, uint target) {
  uint low = 1u;
  uint high = count;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (target < texelFetch(faces, face_texel(middle), 0).g) high = middle;
    else low = middle + 1u;
  }
  return low;
}

// A point on one face, drawn by weight. All 32 bits count: the sum of weights may need them.
PerLobe face_light(Grid grid, texture3D distance_field, texture3D normals, texture3D materials, PathVertex vertex,
                   uvec4 bits) {
  uvec2 head = texelFetch(faces, ivec2(0), 0).rg;
  if (head.x == 0u || head.y == 0u) return kNoLight;
  uint target, rest;
  umulExtended(bits.x, head.y, target, rest);
  uint found = find_face(head.x, target);
  uvec2 entry = texelFetch(faces, face_texel(found), 0).rg;
  uint before = found > 1u ? texelFetch(faces, face_texel(found - 1u), 0).g : 0u;
  ivec3 voxel = face_voxel(entry.x);
  ivec3 face = face_normal(entry.x & 7u);
  int axis = int(entry.x & 7u) / 2;
  vec3 point = vec3(voxel) + uniform_floats(bits).yzw;
  point[axis] = float(voxel[axis] + max(face[axis], 0));
  vec3 path = point - vertex.origin;
  float t = length(path);
  vec3 direction = path / max(t, 1e-20);
  float pdf = face_solid_angle_pdf(float(entry.y - before) / float(head.y), t, -dot(vec3(face), direction));
  uint emission = from_unorm(texelFetch(materials, voxel, 0).a);
  vec3 normal = decode_voxel_normal(texelFetch(normals, voxel, 0), voxels_normal_bits);
  if (pdf <= 0.0 || !emits_along(emission, normal, direction)) return kNoLight;
  PerLobe reflected = reflectance_towards(vertex, direction);
  if (is_black(reflected)) return kNoLight;
  // A sphere march may notice the voxel as late as when it leaves it.
  MarchHit hit = march_grid(distance_field, vertex.origin, direction, t + 2.0);
  if (!hit.hit || hit.voxel != voxel) return kNoLight;
  return scaled(reflected, voxel_radiance(grid, emission) * light_sample_weight(pdf, scatter_pdf(vertex, direction)));
}

// Is a face in the list? With room for all, all are; else those up to the last.
bool face_listed(uint count, uint code) {
  return count < kFaceCapacity || code <= texelFetch(faces, face_texel(count), 0).r;
}

// Density [sr^-1] with which face_light draws the direction of a ray that hit an emissive voxel.
float face_hit_pdf(texture3D albedo, MarchHit hit, VoxelSurface surface, vec3 origin, vec3 direction) {
  uvec2 head = texelFetch(faces, ivec2(0), 0).rg;
  uint face = face_index(hit.face);
  if (head.y == 0u || !voxel_is_empty(albedo, hit.voxel + hit.face)) return 0.0;
  if (!face_listed(head.x, face_code(hit.voxel, face))) return 0.0;
  float probability = float(face_weight(surface.emission, surface.normal, face)) / float(head.y);
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
// met the voxel's [m], `origin` as it was marched from [grid units].
vec3 emitter_hit(Grid grid, texture3D albedo, MarchHit hit, VoxelSurface surface, vec3 from, vec3 at, vec3 origin,
                 vec3 direction, BsdfSample scatter) {
  if (!has_emissive || surface.emission == 0u || !emits_along(surface.emission, surface.normal, direction))
    return vec3(0.0);
  vec3 path = at - from;
  float pdf = nee == kNeeHints ? hint_hit_pdf(surface.emission, surface.normal, direction, dot(path, path))
                               : face_hit_pdf(albedo, hit, surface, origin, direction);
  return voxel_radiance(grid, surface.emission) * light_hit_weight(scatter, pdf);
}

#endif
