// Next event estimation at a vertex of a path among triangles, and the light of emissive triangles that rays meet.
#ifndef LIGHTLOOM_LIB_RAY_LIGHTS
#define LIGHTLOOM_LIB_RAY_LIGHTS

#include "lib/environment_light.glsl"
#include "lib/hints.glsl"
#include "lib/path_random.glsl"
#include "lib/punctual.glsl"
#include "lib/ray_vertex.glsl"
#include "lib/sun.glsl"

// Lights may not come closer than this to what they light [m]: the inverse square of less has no digits left.
float closest_light() { return 1e-6 * length(frame.scene_max.xyz - frame.scene_min.xyz) + 1e-18; }

PerLobe distant_light(PathVertex vertex, LightSample far) {
  if (is_black(far.light) || !is_free(vertex.origin, far.direction, kFarAway)) return kNoLight;
  return far.light;
}

bool sees_point(PathVertex vertex, vec3 target) { return is_free(vertex.origin, target - vertex.origin, 1.0); }

// What a hint's point emits. Texels that are too dim to be drawn are left to the rays that meet them, and so is nothing
// that is cut out.
vec3 hint_radiance(Hint hint) {
  if (emissive_pages == 0u && !has_alpha) return lights.emissions[uint(hint.position.w)].radiance.rgb;
  Triangle t = triangle_at(uint(hint.normal.w));
  vec3 w = nearest_barycentric(hint.position.xyz, world_corners(t));
  TexturePoint point = texture_point(t, w);
  vec3 emission = material_emission(t.material, point);
  bool there = !cut_out(t.material, material_alpha(t.material, point, interpolate_color(t, w)));
  return there && emission_index(t.material, emission) != 0u ? emission : vec3(0.0);
}

PerLobe emitter_light(PathVertex vertex, float u) {
  Hint hint;
  if (!has_emissive || !kSampleLights || !pick_hint(u, hint)) return kNoLight;
  LightSample near = hint_sample(vertex, hint, hint_radiance(hint), closest_light());
  if (is_black(near.light)) return kNoLight;
  // The ray ends off the light's own plane, on the side that it comes from.
  float magnitude = max(largest_coordinate(frame.scene_min.xyz), largest_coordinate(frame.scene_max.xyz));
  vec3 side = dot(hint.normal.xyz, near.direction) < 0.0 ? hint.normal.xyz : -hint.normal.xyz;
  vec3 target = hint.position.xyz + side * plane_clearance(magnitude);
  return sees_point(vertex, target) ? near.light : kNoLight;
}

PerLobe punctual_light(PathVertex vertex, float u) {
  PunctualLight source;
  if (!pick_punctual(u, source)) return kNoLight;
  LightSample near = punctual_sample(vertex, source, closest_light());
  if (uint(source.direction.w) == kPunctualDirectional) return distant_light(vertex, near);
  return !is_black(near.light) && sees_point(vertex, source.position.xyz) ? near.light : kNoLight;
}

// Direct light that each lobe reflects at vertex `bounce` of a path.
PerLobe direct_light(PathVertex vertex, RandomKey key, uint bounce) {
  vec4 u = path_random4(key, bounce, kDimensionLight);
  PerLobe light = emitter_light(vertex, u.x);
  light = sum_of(light, distant_light(vertex, sun_sample(vertex, u.yz)));
  if (environment_sampled()) {
    LightSample sky = environment_sample(vertex, path_random4(key, bounce, kDimensionEnvironment));
    light = sum_of(light, distant_light(vertex, sky));
  }
  return sum_of(light, punctual_light(vertex, u.w));
}

// Radiance that a scattered ray from `from` [m] adds by the surface that it met.
vec3 emitted_light(SurfaceHit hit, vec3 from, vec3 direction, BsdfSample scatter) {
  if (hit.emission_entry == 0u) return hit.emission;
  vec3 path = hit.vertex.position - from;
  float pdf = hint_hit_pdf(hit.emission_entry, hit.vertex.geometric_normal, direction, dot(path, path));
  return hit.emission * light_hit_weight(scatter, pdf);
}

#endif
