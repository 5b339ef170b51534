// Best traced pixel for each pixel of the view. See passes/upsample.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/filter.glsl"
#include "lib/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform texture2D trace_surface_position;
uniform texture2D trace_surface_normal;
uniform utexture2D trace_surface_id;
uniform texture2D surface_position;
uniform texture2D surface_normal;
uniform utexture2D surface_id;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  uint rings;
  float threshold;
};

struct Wanted {
  vec3 position;
  vec3 normal;
  uint object;
  float scale;   // distance at which likeness has fallen to 1/e [m]
};

struct Candidate {
  ivec2 pixel;
  float score;   // 0 to 1; below 0: none yet
};

// Likeness of a traced pixel: of position times of normal, with pixels of other objects far behind.
float likeness(Wanted wanted, ivec2 pixel) {
  vec4 position = texelFetch(trace_surface_position, pixel, 0);
  if (!(position.w > 0.0)) return -1.0;
  vec3 offset = (position.xyz - wanted.position) / wanted.scale;
  float facing = max(dot(texelFetch(trace_surface_normal, pixel, 0).xyz, wanted.normal), 0.0);
  float facing4 = facing * facing * facing * facing;
  float score = exp(-dot(offset, offset)) * facing4 * facing4;
  return texelFetch(trace_surface_id, pixel, 0).x == wanted.object ? score : 0.1 * score;
}

void consider(Wanted wanted, ivec2 pixel, inout Candidate best) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  float score = likeness(wanted, pixel);
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

Wanted load_wanted(ivec2 pixel, vec4 position, vec2 trace_size) {
  Wanted wanted;
  wanted.position = position.xyz;
  wanted.normal = texelFetch(surface_normal, pixel, 0).xyz;
  wanted.object = texelFetch(surface_id, pixel, 0).x;
  float clip_w = (frame.view_projection[0] * vec4(position.xyz, 1.0)).w;
  vec3 to_viewer = normalize(frame.eye[0].xyz - position.xyz * frame.eye[0].w);
  float slant = max(abs(dot(wanted.normal, to_viewer)), 0.05);
  wanted.scale = 2.0 * pixel_footprint(frame.view_projection[0], clip_w, trace_size) / slant;
  return wanted;
}

void main() {
  ivec2 size = textureSize(surface_position, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 position = texelFetch(surface_position, pixel, 0);
  vec4 result = vec4(0.0);
  if (position.w > 0.0) {
    ivec2 trace_size = textureSize(radiance, 0);
    Wanted wanted = load_wanted(pixel, position, vec2(trace_size));
    // In integers, (2 pixel + 1) / 2 * trace_size / size: exact for every size.
    ivec2 centre = (2 * pixel + 1) * trace_size / (2 * size);
    Candidate best = Candidate(centre, -1.0);
    consider(wanted, centre, best);
    for (int ring = 1; ring <= int(rings) && best.score < threshold; ++ring) consider_ring(wanted, centre, ring, best);
    if (best.score >= 0.0) result = texelFetch(radiance, best.pixel, 0);
  }
  imageStore(out_radiance, pixel, result);
}
