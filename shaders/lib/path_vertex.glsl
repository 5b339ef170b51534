// Where a path meets a surface, and what that surface does with light.
#ifndef LIGHTLOOM_LIB_PATH_VERTEX
#define LIGHTLOOM_LIB_PATH_VERTEX

#include "lib/bsdf.glsl"
#include "lib/sampling.glsl"

struct PathVertex {
  vec3 position;           // [m]
  vec3 origin;             // where rays leave, clear of the surface: in grid units among voxels, in metres among triangles
  vec3 geometric_normal;   // unit, on the side that the path came from
  LocalFrame basis;        // around the shading normal
  vec3 incoming;           // unit, towards where the path came from, in `basis`
  Bsdf bsdf;
};

// One sample of a light as a vertex would see it if nothing were in the way.
struct LightSample {
  vec3 direction;          // unit, towards the light
  PerLobe light;           // that the lobes reflect, times the sample's share; black: there is nothing to look for
};

const PerLobe kNoLight = PerLobe(vec3(0.0), vec3(0.0));

bool is_black(PerLobe light) { return light.diffuse + light.specular == vec3(0.0); }

// f cos of each lobe for light from a unit world direction; black behind the surface.
PerLobe reflectance_towards(PathVertex vertex, vec3 direction) {
  vec3 o = to_local(vertex.basis, direction);
  if (dot(direction, vertex.geometric_normal) <= 0.0) return kNoLight;
  return scaled(bsdf_evaluate_lobes(vertex.bsdf, vertex.incoming, o), vec3(max(o.z, 0.0)));
}

const LightSample kNoLightSample = LightSample(vec3(0.0, 0.0, 1.0), kNoLight);

// Density with which bsdf_sample picks a unit world direction [sr^-1].
float scatter_pdf(PathVertex vertex, vec3 direction) {
  return bsdf_pdf(vertex.bsdf, vertex.incoming, to_local(vertex.basis, direction));
}

#endif
