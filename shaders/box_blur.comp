// Mean over a row or column of pixels. See passes/box_blur.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/neighbour.glsl"
#include "lib/storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_radiance;

layout(constant_id = 11) const float out_radiance_largest = 65504.0;

layout(constant_id = 10) const uint cutoff = 0u;   // 0: radial, 1: elliptic

layout(push_constant) uniform Params {
  uint axis;   // 0: x, 1: y
  uint radius;
  float floor_fraction;
  float distance_fraction;
  float normal_threshold;
  float variance_guide;
  float full_width_error;
  float difference_limit;
};

// Within the ellipse around the centre on its surface? Multiplied out, for half axes may be 0.
bool within_ellipse(Centre centre, vec3 offset) {
  vec2 place = vec2(dot(offset, centre.tangent), dot(offset, centre.bitangent)) * centre.reach.yx;
  float limit = centre.reach.x * centre.reach.y;
  return dot(place, place) <= limit * limit;
}

void add_within_cutoff(Centre centre, ivec2 pixel, inout vec4 sum) {
  Neighbour neighbour = load_neighbour(centre, pixel);
  bool within = cutoff == 0u || within_ellipse(centre, offset_from(centre, neighbour.guide));
  neighbour.counts = neighbour.counts && within;
  add_neighbour(neighbour, sum);
}

vec4 mean_along(Centre centre, ivec2 direction) {
  int taps = min(int(radius), max(int(round(float(radius) * centre.kept)), 1));
  vec4 sum = vec4(centre.radiance.rgb, 1.0);
  for (int k = 1; k <= taps; ++k) {
    add_within_cutoff(centre, centre.pixel + direction * k, sum);
    add_within_cutoff(centre, centre.pixel - direction * k, sum);
  }
  return vec4(sum.rgb / sum.a, centre.radiance.a);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  FilterShape shape = FilterShape(floor_fraction, distance_fraction, normal_threshold, variance_guide,
                                  full_width_error, difference_limit);
  Centre centre;
  bool filtered = load_centre(pixel, shape, centre);
  vec4 mean = mean_along(centre, axis == 0u ? ivec2(1, 0) : ivec2(0, 1));
  imageStore(out_radiance, pixel, storable(filtered ? mean : centre.radiance, out_radiance_largest));
}
