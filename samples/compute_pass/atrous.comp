// One step of the edge-avoiding a-trous wavelet filter (Dammertz, Sewtz, Hanika, Lensch, HPG 2010): a 5x5 B-spline whose
// taps lie `stride` pixels apart, weighed down across edges of the surface. Steps of 1, 2, 4 make it 29 pixels wide.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform texture2D surface_position;   // xyz [m]; w: view depth [m], 0 for the background
uniform texture2D surface_normal;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  int stride;           // [pixels]
  float normal_power;   // of the cosine between the two normals
};
layout(constant_id = 0) const float plane_distance = 0.005;   // that halves a weight, in view depths

const float kSpline[3] = float[](0.375, 0.25, 0.0625);

// How much of `pixel` belongs to the surface at `position`.
float alike(ivec2 pixel, vec4 position, vec3 normal) {
  vec4 there = texelFetch(surface_position, pixel, 0);
  float cosine = dot(normal, texelFetch(surface_normal, pixel, 0).xyz);
  if (there.w <= 0.0 || cosine <= 0.0) return 0.0;
  float distance = abs(dot(there.xyz - position.xyz, normal));
  return pow(cosine, normal_power) * exp2(-distance / (plane_distance * position.w));
}

void main() {
  ivec2 size = textureSize(radiance, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 centre = texelFetch(radiance, pixel, 0);
  vec4 position = texelFetch(surface_position, pixel, 0);
  vec3 normal = texelFetch(surface_normal, pixel, 0).xyz;
  vec4 sum = vec4(centre.rgb, 1.0) * kSpline[0] * kSpline[0];
  for (int y = -2; y <= 2 && position.w > 0.0; ++y) {
    for (int x = -2; x <= 2; ++x) {
      ivec2 tap = pixel + stride * ivec2(x, y);
      if (tap == pixel || any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, size))) continue;
      float weight = kSpline[abs(x)] * kSpline[abs(y)] * alike(tap, position, normal);
      sum += weight * vec4(texelFetch(radiance, tap, 0).rgb, 1.0);
    }
  }
  imageStore(out_radiance, pixel, vec4(sum.rgb / sum.a, centre.a));
}
