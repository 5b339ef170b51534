// Paths from the G-buffer among the scene's triangles. See passes/ray_query_path_trace.cpp for the ports and params.
//
// Vertex 0 is the first hit. Every vertex gathers direct light; the ray that leaves it adds its share of what it meets: an
// emissive surface, the sun's disc or the environment. So light that was scattered 1 to bounces + 1 times is counted,
// from every kind of source.
#version 460
#extension GL_EXT_ray_query : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/features.glsl"
#include "lib/first_hit.glsl"
#include "lib/ray_lights.glsl"
#include "lib/traced_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform utexture2D surface_id;

layout(push_constant) uniform Params {
  uint paths;
  uint bounces;
  float regularization;
};

// Light that arrives at vertex 0 along the scattered ray.
vec3 trace_incoming(PathVertex vertex, BsdfSample scatter, RandomKey key) {
  vec3 radiance = vec3(0.0);
  vec3 throughput = vec3(1.0);
  float least_alpha = 0.0;
  for (uint bounce = 1u;; ++bounce) {
    vec3 direction = to_world(vertex.basis, scatter.direction);
    if (!(dot(direction, vertex.geometric_normal) > 0.0)) break;   // nor may what is no number reach a ray
    RayHit met = trace_ray(vertex.origin, direction, kFarAway, gl_RayFlagsNoneEXT);
    if (!met.found) {
      radiance += throughput * (environment_hit(direction, scatter) + sun_hit(direction, scatter));
      break;
    }
    vec3 from = vertex.position;
    least_alpha = max(least_alpha, min(scatter.roughness, regularization));
    SurfaceHit hit = surface_hit(met, direction, least_alpha);
    radiance += throughput * emitted_light(hit, from, direction, scatter);
    if (bounce > bounces) break;
    vertex = hit.vertex;
    PerLobe direct = direct_light(vertex, key, bounce);
    radiance += throughput * (direct.diffuse + direct.specular);
    scatter = bsdf_sample(vertex.bsdf, vertex.incoming, path_random4(key, bounce, kDimensionScatter).xyz);
    throughput *= scatter.weight;
    if (throughput == vec3(0.0)) break;
  }
  return radiance;
}

// Light that each lobe of the first hit scatters to the viewer.
PerLobe trace_path(PathVertex first, RandomKey key) {
  PerLobe light = direct_light(first, key, 0u);
  BsdfSample scatter = bsdf_sample(first.bsdf, first.incoming, path_random4(key, 0u, kDimensionScatter).xyz);
  if (scatter.weight == vec3(0.0)) return light;
  vec3 incoming = trace_incoming(first, scatter, key);
  light.diffuse += max(scatter.weight - scatter.specular_weight, vec3(0.0)) * incoming;
  light.specular += scatter.specular_weight * incoming;
  return light;
}

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  bool lit = is_lit(pixel);
  TracedLight sum = kNothingTraced;
  if (lit) {
    PathVertex first = first_hit(pixel);
    refine_first_hit(first, texelFetch(surface_id, pixel, 0).z);
    RandomKey key = RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, paths);
    for (key.path = 0u; key.path < paths; ++key.path) add_path(sum, first, trace_path(first, key));
  }
  store_light(pixel, sum, paths, lit);
}
