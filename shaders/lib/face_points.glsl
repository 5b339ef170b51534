// Points on the exposed faces of emissive voxels: how likely each is drawn, and what it sends to a vertex as far as nothing
// is in the way.
#ifndef LIGHTLOOM_LIB_FACE_POINTS
#define LIGHTLOOM_LIB_FACE_POINTS

#include "lib/emissive_faces.glsl"
#include "lib/grid.glsl"
#include "lib/mis.glsl"
#include "lib/path_vertex.glsl"
#include "lib/random.glsl"
#include "lib/voxel_bits.glsl"

const uint kEmitterVoxels = 0u;
const uint kEmitterSurface = 1u;
layout(constant_id = 25) const uint emitter_area = 0u;

uniform utexture2D faces;
uniform utexture2D power;

struct FacePoint {
  ivec3 voxel;
  uint face;           // face_normal
  vec3 position;       // [grid units]
  float probability;   // with which draw_face_point picks this face; 0: there is no such point
};
const FacePoint kNoFacePoint = FacePoint(ivec3(0), 0u, vec3(0.0), 0.0);

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

// The axis across a face.
int face_axis(uint face) { return int(face) / 2; }

// Where on a face, by coordinates from 0 to 1 along all three axes; that across the face does not count.
vec3 place_on_face(ivec3 voxel, uint face, vec3 within) {
  int axis = face_axis(face);
  vec3 position = vec3(voxel) + within;
  position[axis] = float(voxel[axis] + max(face_normal(face)[axis], 0));
  return position;
}

// A point on one face, drawn by weight: by x, all bits of which the sum of weights may need, the face, by yzw where on it.
FacePoint draw_face_point(uvec4 bits) {
  uvec2 head = texelFetch(faces, ivec2(0), 0).rg;
  if (head.x == 0u || head.y == 0u) return kNoFacePoint;
  uint target, rest;
  umulExtended(bits.x, head.y, target, rest);
  uint found = find_face(head.x, target);
  uvec2 entry = texelFetch(faces, face_texel(found), 0).rg;
  uint before = found > 1u ? texelFetch(faces, face_texel(found - 1u), 0).g : 0u;
  ivec3 voxel = face_voxel(entry.x);
  uint face = entry.x & 7u;
  return FacePoint(voxel, face, place_on_face(voxel, face, uniform_floats(bits).yzw),
                   float(entry.y - before) / float(head.y));
}

// Is a face in the list? With room for all, all are; else those up to the last.
bool face_listed(uint count, uint code) {
  return count < kFaceCapacity || code <= texelFetch(faces, face_texel(count), 0).r;
}

// Probability with which draw_face_point picks a face of an emissive voxel.
float face_probability(texture3D albedo, ivec3 voxel, uint face, uint emission, vec3 voxel_normal) {
  uvec2 head = texelFetch(faces, ivec2(0), 0).rg;
  if (head.y == 0u || !voxel_is_empty(albedo, voxel + face_normal(face))) return 0.0;
  if (!face_listed(head.x, face_code(voxel, face))) return 0.0;
  return float(face_weight(emission, voxel_normal, face)) / float(head.y);
}

// The way from where a vertex's rays start to a point; xyz: unit direction, w: length [voxels].
vec4 way_to_face(PathVertex vertex, FacePoint point) {
  vec3 path = point.position - vertex.origin;
  float t = length(path);
  return vec4(path / max(t, 1e-20), t);
}

// What a vertex reflects of a point's light by next event estimation, with its share, if nothing is in the way. `draws`: of
// so many the point counts for in the share, beside one scattered ray.
PerLobe face_point_light(Grid grid, texture3D normals, texture3D materials, PathVertex vertex, FacePoint point,
                         float draws) {
  vec4 way = way_to_face(vertex, point);
  float pdf = face_solid_angle_pdf(point.probability, way.w, -dot(vec3(face_normal(point.face)), way.xyz));
  uint emission = from_unorm(texelFetch(materials, point.voxel, 0).a);
  vec3 normal = decode_voxel_normal(texelFetch(normals, point.voxel, 0), voxels_normal_bits);
  if (pdf <= 0.0 || !emits_along(emission, normal, way.xyz)) return kNoLight;
  PerLobe reflected = reflectance_towards(vertex, way.xyz);
  if (is_black(reflected)) return kNoLight;
  float weight = draws * light_sample_weight(draws * pdf, scatter_pdf(vertex, way.xyz));
  return scaled(reflected, voxel_radiance(grid, emission) * weight);
}

#endif
