// Accumulation over earlier frames, whose surfaces are packed. See passes/temporal_accumulate.cpp for the ports and params.
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
  uint trail_point_ring;
  uint trail_point_newest_layer;
};

uniform utexture2DArray trail_point;

#include "lib/packed_surface.glsl"
#include "lib/reference_point.glsl"
#include "lib/temporal.glsl"

Seen seen_in_frame(uint age, ivec2 pixel, uvec4 id) {
  uint layer = layer_of(trail_point_newest_layer, trail_point_ring, age);
  PackedSurface surface = unpack_surface(texelFetch(trail_point, ivec3(pixel, layer), 0));
  bool same = surface.object == id.x % kPackedIds && surface.material == id.y % kPackedIds;
  return Seen(surface.point.position + reference_point(age), surface.point.normal, same && surface.object != 0u);
}

void main() { accumulate(); }
