// What reservoirs of light samples are to be like: the target density of a point on a face at a vertex. Whoever
// includes this declares the push constant `reservoir_draws`.
#ifndef LIGHTLOOM_LIB_RESERVOIR_TARGET
#define LIGHTLOOM_LIB_RESERVOIR_TARGET

#include "lib/color.glsl"
#include "lib/face_points.glsl"
#include "lib/reservoir.glsl"
#include "lib/voxels.glsl"

// The point that a code and a place mean; none where the voxel does not emit (any more) or its face is hidden.
FacePoint face_point_at(texture3D albedo, texture3D normals, texture3D materials, uint code, uint place) {
  ivec3 voxel = face_voxel(code);
  uint face = code & 7u;
  if (voxel_is_empty(albedo, voxel)) return kNoFacePoint;
  uint emission = from_unorm(texelFetch(materials, voxel, 0).a);
  if (emission == 0u) return kNoFacePoint;
  vec3 normal = decode_voxel_normal(texelFetch(normals, voxel, 0), voxels_normal_bits);
  return FacePoint(voxel, face, place_on_face(voxel, face, unpack_place(place, face_axis(face))),
                   face_probability(albedo, voxel, face, emission, normal));
}

FacePoint face_point_of(Reservoir reservoir) {
  if (!(reservoir.weight > 0.0)) return kNoFacePoint;
  return face_point_at(voxels_albedo, voxels_normal, voxels_material, reservoir.code, reservoir.place);
}

// Luminance of what next event estimation adds at the vertex by this point, with its share of multiple importance
// sampling but whatever is in the way, per area of the face: face_point_light estimates by one draw what this integrates to.
float light_target(Grid grid, PathVertex vertex, FacePoint point) {
  if (!(point.probability > 0.0)) return 0.0;
  PerLobe light = face_point_light(grid, voxels_normal, voxels_material, vertex, point, reservoir_draws);
  float target = luminance(light.diffuse + light.specular) * point.probability;
  return is_finite(target) ? target : 0.0;
}

#endif
