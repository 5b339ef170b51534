// Mean along a surface direction, marched on the screen. See passes/denoise_radial.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/neighbour.glsl"
#include "lib/storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_radiance;

layout(constant_id = 11) const float out_radiance_largest = 65504.0;

layout(push_constant) uniform Params {
  uint axis;   // 0: tangent, 1: bitangent
  uint taps;
  float floor_fraction;
  float distance_fraction;
  float normal_threshold;
  float variance_guide;
  float full_width_error;
  float difference_limit;
};

// What is marched of one side of the centre: so many taps, a stride apart [pixels].
struct Side {
  vec2 stride;
  float count;
};

// Along a direction of the world as it appears on the screen, one tap for each pixel that is crossed. If there are more
// than `taps`, they spread over the whole length. Where the full length crosses a pixel, so does what a guide leaves of it.
Side make_side(Centre centre, vec4 origin, vec4 slope, float reach_along) {
  vec2 size = vec2(textureSize(radiance, 0));
  // Towards the viewer, stop half way: behind the eye nothing can be projected.
  float reach = slope.w < 0.0 ? min(reach_along, -0.5 * origin.w / slope.w) : reach_along;
  vec2 path = clip_to_pixel(origin + slope * reach, size) - clip_to_pixel(origin, size);
  float crossed = max(abs(path.x), abs(path.y));
  float kept = max(crossed * centre.kept, 1.0);
  float count = min(floor(kept), float(taps));
  vec2 stride = path / crossed * (count < floor(kept) ? kept / count : 1.0);
  return Side(stride, crossed >= 1.0 ? count : 0.0);
}

// Mean of the taps on both sides and the centre. One loop for both, for pixels computed together wait for the longest.
vec4 march(Centre centre) {
  vec4 origin = frame.view_projection[0] * vec4(centre.position.xyz, 1.0);
  vec4 slope = frame.view_projection[0] * vec4(axis == 0u ? centre.tangent : centre.bitangent, 0.0);
  float reach_along = axis == 0u ? centre.reach.x : centre.reach.y;
  Side ahead = make_side(centre, origin, slope, reach_along);
  Side behind = make_side(centre, origin, -slope, reach_along);
  vec2 start = vec2(centre.pixel) + 0.5;
  vec4 sum = vec4(centre.radiance.rgb, 1.0);
  for (float k = 1.0; k <= ahead.count + behind.count; ++k) {
    vec2 step = k <= ahead.count ? ahead.stride * k : behind.stride * (k - ahead.count);
    add_neighbour(load_neighbour(centre, ivec2(floor(start + step))), sum);
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
  vec4 mean = march(centre);
  imageStore(out_radiance, pixel, storable(filtered ? mean : centre.radiance, out_radiance_largest));
}
