// Accumulation over earlier frames, whose surfaces are images of the G-buffer. See passes/temporal_accumulate.cpp for the
// ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Params {
  uint frames;
  float position_tolerance;
  float normal_threshold;
  uint trail_count;
  uint trail_first_age;
  uint trail_ring;
  uint trail_newest_layer;
  uint trail_position_ring;
  uint trail_position_newest_layer;
  uint trail_normal_ring;
  uint trail_normal_newest_layer;
  uint trail_id_ring;
  uint trail_id_newest_layer;
};

layout(constant_id = 1) const bool trail_id_bound = true;

uniform texture2DArray trail_position;
uniform texture2DArray trail_normal;
uniform utexture2DArray trail_id;

#include "lib/temporal.glsl"

Seen seen_in_frame(uint age, ivec2 pixel, uvec4 id) {
  uint position_layer = layer_of(trail_position_newest_layer, trail_position_ring, age);
  vec4 position = texelFetch(trail_position, ivec3(pixel, position_layer), 0);
  uint normal_layer = layer_of(trail_normal_newest_layer, trail_normal_ring, age);
  Seen seen = Seen(position.xyz, texelFetch(trail_normal, ivec3(pixel, normal_layer), 0).xyz, position.w > 0.0);
  if (trail_id_bound) {
    uint id_layer = layer_of(trail_id_newest_layer, trail_id_ring, age);
    if (!same_material(texelFetch(trail_id, ivec3(pixel, id_layer), 0), id)) seen.same = false;
  }
  return seen;
}

void main() { accumulate(); }
