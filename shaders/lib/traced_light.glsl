// What a pass that traces light leaves behind: for each pixel the mean over its paths, of both lobes together and of each,
// divided by the modulation colour.
#ifndef LIGHTLOOM_LIB_TRACED_LIGHT
#define LIGHTLOOM_LIB_TRACED_LIGHT

#include "lib/modulation.glsl"
#include "lib/path_vertex.glsl"
#include "lib/storage.glsl"

uniform writeonly image2D out_radiance;
uniform writeonly image2D out_diffuse;
uniform writeonly image2D out_specular;

layout(constant_id = 0) const bool radiance_wanted = true;
layout(constant_id = 1) const bool diffuse_wanted = true;
layout(constant_id = 2) const bool specular_wanted = true;
layout(constant_id = 4) const float out_radiance_largest = 65504.0;
layout(constant_id = 5) const float out_diffuse_largest = 65504.0;
layout(constant_id = 6) const float out_specular_largest = 65504.0;

struct TracedLight {
  vec3 radiance;
  PerLobe lobes;
};
const TracedLight kNothingTraced = TracedLight(vec3(0.0), kNoLight);

// The square, with which the filters reckon, and sums of it still fit into a float.
const float kLargestLight = 1e18;

// Nothing that is not a number may reach the filters, which would spread it.
vec3 bounded(vec3 light) { return is_finite(light) ? min(light, vec3(kLargestLight)) : vec3(0.0); }

// Adds what one path from `first` found.
void add_path(inout TracedLight sum, PathVertex first, PerLobe light) {
  float cosine = first.incoming.z;
  sum.radiance += bounded((light.diffuse + light.specular) / modulation_color(first.bsdf, cosine));
  sum.lobes.diffuse += bounded(light.diffuse / diffuse_modulation(first.bsdf, cosine));
  sum.lobes.specular += bounded(light.specular / specular_modulation(first.bsdf, cosine));
}

void store_light(ivec2 pixel, TracedLight sum, uint paths, bool lit) {
  float coverage = lit ? 1.0 : 0.0;
  if (radiance_wanted) imageStore(out_radiance, pixel, storable(vec4(sum.radiance / float(paths), coverage), out_radiance_largest));
  if (diffuse_wanted) imageStore(out_diffuse, pixel, storable(vec4(sum.lobes.diffuse / float(paths), coverage), out_diffuse_largest));
  if (specular_wanted) imageStore(out_specular, pixel, storable(vec4(sum.lobes.specular / float(paths), coverage), out_specular_largest));
}

#endif
