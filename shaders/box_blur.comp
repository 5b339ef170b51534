// Mean over a row or column of pixels. See passes/box_blur.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/neighbour.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  uint axis;   // 0: x, 1: y
  uint radius;
  float floor_fraction;
  float distance_fraction;
  float normal_threshold;
};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  Centre centre;
  if (!load_centre(pixel, floor_fraction * scene_diagonal(), distance_fraction, centre)) {
    imageStore(out_radiance, pixel, centre.radiance);
    return;
  }
  ivec2 direction = axis == 0u ? ivec2(1, 0) : ivec2(0, 1);
  vec4 sum = vec4(centre.radiance.rgb, 1.0);
  for (int k = 1; k <= int(radius); ++k) {
    add_neighbour(centre, pixel + direction * k, normal_threshold, sum);
    add_neighbour(centre, pixel - direction * k, normal_threshold, sum);
  }
  imageStore(out_radiance, pixel, vec4(sum.rgb / sum.a, centre.radiance.a));
}
