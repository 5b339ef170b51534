// Traced pixels for each pixel of the view. See passes/upsample.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/features.glsl"
#include "lib/filter.glsl"
#include "lib/scene.glsl"
#include "lib/storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint filter_kind = 0u;   // the param `filter`, a word that GLSL reserves; 0: bilateral, 1: nearest
layout(constant_id = 1) const bool specular_bound = false;
layout(constant_id = 2) const bool specular_wanted = false;
layout(constant_id = 3) const float out_radiance_largest = 65504.0;
layout(constant_id = 4) const float out_specular_largest = 65504.0;

uniform texture2D radiance;
uniform texture2D specular;
uniform texture2D trace_surface_position;
uniform texture2D trace_surface_normal;
uniform utexture2D trace_surface_id;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform texture2D surface_geometric_normal;
uniform utexture2D surface_id;
uniform writeonly image2D out_radiance;
uniform writeonly image2D out_specular;

layout(push_constant) uniform Params {
  uint rings;
  float threshold;
};

const bool brings_specular = specular_bound && specular_wanted && has_specular;

struct Wanted {
  vec3 position;
  vec3 normal;
  vec3 plane;        // unit face normal
  uint object;
  float footprint;   // width of a traced pixel, seen head on [m]
  float slant;       // cosine between the normal and the direction to the viewer
};

struct Result {
  vec4 radiance;
  vec4 specular;
};

Wanted load_wanted(ivec2 pixel, vec3 position, vec2 trace_size) {
  Wanted wanted;
  wanted.position = position;
  wanted.normal = texelFetch(surface_normal, pixel, 0).xyz;
  wanted.plane = texelFetch(surface_geometric_normal, pixel, 0).xyz;
  wanted.object = texelFetch(surface_id, pixel, 0).x;
  float clip_w = (frame.view_projection[0] * vec4(position, 1.0)).w;
  vec3 to_viewer = normalize(frame.eye[0].xyz - position * frame.eye[0].w);
  wanted.footprint = pixel_footprint(frame.view_projection[0], clip_w, trace_size);
  wanted.slant = max(abs(dot(wanted.normal, to_viewer)), 0.05);
  return wanted;
}

bool within_trace(ivec2 pixel) {
  return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, textureSize(radiance, 0)));
}

// Likeness of the normals, 0 to 1: the eighth power of their cosine.
float facing_likeness(Wanted wanted, ivec2 pixel) {
  float facing = max(dot(texelFetch(trace_surface_normal, pixel, 0).xyz, wanted.normal), 0.0);
  float facing4 = facing * facing * facing * facing;
  return facing4 * facing4;
}

Result fetch(ivec2 pixel) {
  return Result(texelFetch(radiance, pixel, 0), brings_specular ? texelFetch(specular, pixel, 0) : vec4(0.0));
}

// --- The search -----------------------------------------------------------------------------------------------------

struct Candidate {
  ivec2 pixel;
  float score;   // 0 to 1 of another object, 1 to 2 of the same; below 0: none yet
};

void consider(Wanted wanted, ivec2 pixel, inout Candidate best) {
  if (!within_trace(pixel)) return;
  vec4 position = texelFetch(trace_surface_position, pixel, 0);
  if (!(position.w > 0.0)) return;
  vec3 offset = (position.xyz - wanted.position) * (wanted.slant / (2.0 * wanted.footprint));
  float score = exp(-dot(offset, offset)) * facing_likeness(wanted, pixel);
  if (texelFetch(trace_surface_id, pixel, 0).x == wanted.object) score += 1.0;
  if (score > best.score) best = Candidate(pixel, score);
}

void consider_ring(Wanted wanted, ivec2 centre, int ring, inout Candidate best) {
  for (int k = -ring; k <= ring; ++k) {
    consider(wanted, centre + ivec2(k, -ring), best);
    consider(wanted, centre + ivec2(k, ring), best);
  }
  for (int k = 1 - ring; k < ring; ++k) {
    consider(wanted, centre + ivec2(-ring, k), best);
    consider(wanted, centre + ivec2(ring, k), best);
  }
}

// From the inside out to the first ring with a pixel of the same object that is alike enough.
Result search(Wanted wanted, ivec2 centre) {
  Candidate best = Candidate(centre, -1.0);
  consider(wanted, centre, best);
  for (int ring = 1; ring <= int(rings) && best.score < 1.0 + threshold; ++ring)
    consider_ring(wanted, centre, ring, best);
  return best.score >= 0.0 ? fetch(best.pixel) : Result(vec4(0.0), vec4(0.0));
}

// --- The blend ------------------------------------------------------------------------------------------------------

// Weight of one of the four around. Likeness of position is that of the distance from the surface's plane: on a plane
// the blend is plain bilinear interpolation.
float blend_weight(Wanted wanted, ivec2 pixel, float bilinear) {
  if (bilinear <= 0.0 || !within_trace(pixel)) return 0.0;
  if (texelFetch(trace_surface_id, pixel, 0).x != wanted.object) return 0.0;
  if (texelFetch(radiance, pixel, 0).a <= 0.0) return 0.0;
  float off_plane = dot(texelFetch(trace_surface_position, pixel, 0).xyz - wanted.position, wanted.plane);
  float footprints = off_plane / wanted.footprint;
  return bilinear * exp(-footprints * footprints) * facing_likeness(wanted, pixel);
}

// False where none of the four is much like the pixel.
bool blend(Wanted wanted, ivec2 base, vec2 fraction, out Result result) {
  const float least = 0.01;
  float weights[4];
  float total = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec2 side = mix(1.0 - fraction, fraction, vec2(k & 1, k >> 1));
    weights[k] = blend_weight(wanted, base + ivec2(k & 1, k >> 1), side.x * side.y);
    total += weights[k];
  }
  result = Result(vec4(0.0), vec4(0.0));
  if (!(total >= least)) return false;
  // As differences to the first: what is the same in all of them keeps its bits.
  Result first;
  bool any_yet = false;
  for (int k = 0; k < 4; ++k) {
    if (weights[k] <= 0.0) continue;
    Result one = fetch(base + ivec2(k & 1, k >> 1));
    if (!any_yet) result = first = one;
    any_yet = true;
    result.radiance += (one.radiance - first.radiance) * (weights[k] / total);
    result.specular += (one.specular - first.specular) * (weights[k] / total);
  }
  return true;
}

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  Result result = Result(vec4(0.0), vec4(0.0));
  if (position.w > 0.0) {
    ivec2 trace_size = textureSize(radiance, 0);
    Wanted wanted = load_wanted(pixel, position.xyz, vec2(trace_size));
    // The pixel's centre among the traced pixels, (2 pixel + 1) / 2 * trace_size / size, in integers: exact for every
    // size.
    ivec2 place = (2 * pixel + 1) * trace_size;
    // Of the four around it, the first; half a pixel further on, so that nothing is below 0.
    ivec2 shifted = place + size;
    ivec2 base = shifted / (2 * size) - 1;
    vec2 fraction = vec2(shifted % (2 * size)) / vec2(2 * size);
    bool blended = filter_kind == 0u && blend(wanted, base, fraction, result);
    if (!blended) result = search(wanted, place / (2 * size));
  }
  imageStore(out_radiance, pixel, storable(result.radiance, out_radiance_largest));
  if (specular_wanted) imageStore(out_specular, pixel, storable(result.specular, out_specular_largest));
}
