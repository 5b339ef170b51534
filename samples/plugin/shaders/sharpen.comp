// Unsharp mask. See sharpen.cpp for the ports and params: a shader's names are theirs.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  float amount;
  int radius;
};

void main() {
  ivec2 size = textureSize(radiance, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 sum = vec4(0.0);
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      sum += vec4(texelFetch(radiance, clamp(pixel + ivec2(x, y), ivec2(0), size - 1), 0).rgb, 1.0);
  vec4 centre = texelFetch(radiance, pixel, 0);
  vec3 sharpened = centre.rgb + amount * (centre.rgb - sum.rgb / sum.a);
  imageStore(out_radiance, pixel, vec4(max(sharpened, vec3(0.0)), centre.a));
}
