// A G-buffer that is the same in every pixel but for rows 0 to 3, where one number of columns 0 to 6 is NaN or infinite:
// of the position (x, y, z, depth), then of the normal. In column 7 the normal is 0.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D out_surface_position;
uniform writeonly image2D out_surface_normal;
uniform writeonly image2D out_surface_geometric_normal;
uniform writeonly image2D out_surface_tangent;
uniform writeonly image2D out_surface_albedo;
uniform writeonly image2D out_surface_material;
uniform writeonly image2D out_surface_emission;
uniform writeonly uimage2D out_surface_id;

const uint kBad[4] = uint[4](0x7fc00000u, 0xffc00000u, 0x7f800000u, 0xff800000u);   // NaN, -NaN, infinity, -infinity

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_surface_position)))) return;
  vec4 position = vec4(1.0, -2.0, 3.0, 4.0);
  vec4 normal = vec4(0.0, 0.6, -0.8, 1.0);
  if (pixel.y < 4 && pixel.x < 4) position[pixel.x] = uintBitsToFloat(kBad[pixel.y]);
  if (pixel.y < 4 && pixel.x >= 4 && pixel.x < 7) normal[pixel.x - 4] = uintBitsToFloat(kBad[pixel.y]);
  if (pixel.y < 4 && pixel.x == 7) normal = vec4(0.0);
  imageStore(out_surface_position, pixel, position);
  imageStore(out_surface_normal, pixel, normal);
  imageStore(out_surface_geometric_normal, pixel, vec4(0.0));
  imageStore(out_surface_tangent, pixel, vec4(0.0));
  imageStore(out_surface_albedo, pixel, vec4(0.0));
  imageStore(out_surface_material, pixel, vec4(0.0));
  imageStore(out_surface_emission, pixel, vec4(0.0));
  imageStore(out_surface_id, pixel, uvec4(7u, 300u, 0u, 0u));
}
