// What rays meet among the scene's triangles (GL_EXT_ray_query). Every triangle is met from both sides, as voxels are; the
// parts of alpha-masked ones that are cut out are not there.
#ifndef LIGHTLOOM_LIB_RAY_SCENE
#define LIGHTLOOM_LIB_RAY_SCENE

#include "lib/material.glsl"
#include "lib/triangle.glsl"

uniform accelerationStructureEXT scene_tlas;
// Four numbers say where the lists of static opaque, static masked, dynamic opaque and dynamic masked triangles start;
// then the lists, of indices into `triangles`. Written by framework/run/scene_accelerator.cpp.
layout(std430) readonly buffer PrimitiveBlock { uint primitives[]; };

const float kFarAway = 1e30;   // longer than any ray [m]

struct RayHit {
  bool found;
  uint triangle;   // index into `triangles`
  vec2 weights;    // barycentric, of corners b and c
};

// `list`: custom index of the instance.
uint met_triangle(int list, int primitive) { return primitives[primitives[list] + primitive]; }

vec3 corner_weights(vec2 weights) { return vec3(1.0 - weights.x - weights.y, weights); }

// Paths do not know how wide they are: textures are read at their finest level.
TexturePoint texture_point(Triangle t, vec3 weights) {
  return TexturePoint(interpolate_texcoords(t, weights), vec4(0.0), vec4(0.0));
}

bool cut_out_at(uint triangle, vec2 weights) {
  Triangle t = triangle_at(triangle);
  vec3 w = corner_weights(weights);
  return cut_out(t.material, material_alpha(t.material, texture_point(t, w), interpolate_color(t, w)));
}

// What the ray meets first (`flags`: gl_RayFlagsNoneEXT) or at all (gl_RayFlagsTerminateOnFirstHitEXT) within `reach`
// lengths of `direction`.
RayHit trace_ray(vec3 origin, vec3 direction, float reach, uint flags) {
  rayQueryEXT query;
  if (!has_alpha) flags |= gl_RayFlagsOpaqueEXT;
  rayQueryInitializeEXT(query, scene_tlas, flags, 0xFFu, origin, 0.0, direction, reach);
  while (rayQueryProceedEXT(query)) {
    if (rayQueryGetIntersectionTypeEXT(query, false) != gl_RayQueryCandidateIntersectionTriangleEXT) continue;
    uint triangle = met_triangle(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false),
                                 rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    if (!cut_out_at(triangle, rayQueryGetIntersectionBarycentricsEXT(query, false)))
      rayQueryConfirmIntersectionEXT(query);
  }
  if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionTriangleEXT)
    return RayHit(false, 0u, vec2(0.0));
  uint triangle = met_triangle(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true),
                               rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
  return RayHit(true, triangle, rayQueryGetIntersectionBarycentricsEXT(query, true));
}

// Is the way free for `reach` lengths of `direction`?
bool is_free(vec3 origin, vec3 direction, float reach) {
  return !trace_ray(origin, direction, reach, gl_RayFlagsTerminateOnFirstHitEXT).found;
}

// How far off its plane a point among coordinates up to `magnitude` [m] has to lie so that rounding cannot make a ray
// meet that plane: telling the side of a plane takes a few differences and products, each good to half a unit in the last
// place (2^-24 of the largest); 32 of these are several times what they add up to.
float plane_clearance(float magnitude) { return magnitude * 1.9073486328125e-6; }

float largest_coordinate(vec3 p) { return max(abs(p.x), max(abs(p.y), abs(p.z))); }
float largest_coordinate(Corners t) {
  return max(largest_coordinate(t.a), max(largest_coordinate(t.b), largest_coordinate(t.c)));
}

#endif
