// The light sample of each pixel out of its own and those of pixels around it. See passes/reuse_reservoirs.cpp for the
// ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Params {
  uint neighbours;
  float radius;
  float depth_tolerance;
  float normal_threshold;
  uint sequence;
  float reservoir_draws;
};

uniform utexture2D reservoir;
uniform writeonly uimage2D out_reservoir;

#include "lib/first_hit.glsl"
#include "lib/reservoir_merge.glsl"
#include "lib/surface_vertex.glsl"

const uint kMostNeighbours = 8u;   // as in passes/reuse_reservoirs.cpp

RandomKey key_of(ivec2 pixel, uint neighbour) {
  return RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, neighbour, 1u);
}

// Is a pixel's surface enough like the one of `pixel` for their lights to be alike? It costs noise alone if they are not.
bool is_alike(ivec2 pixel, ivec2 other) {
  if (other == pixel || !is_lit(other)) return false;
  vec4 position = texelFetch(surface_position, pixel, 0);
  vec3 normal = texelFetch(surface_normal, pixel, 0).xyz;
  vec3 offset = texelFetch(surface_position, other, 0).xyz - position.xyz;
  return dot(texelFetch(surface_normal, other, 0).xyz, normal) >= normal_threshold &&
         abs(dot(offset, normal)) <= depth_tolerance * position.w;
}

// Uniform in the disc around a pixel. Which pixels are chosen must not depend on what their reservoirs hold.
ivec2 neighbour_of(ivec2 pixel, uint index) {
  vec4 u = random4(key_of(pixel, index), sequence, kDimensionNeighbour);
  float angle = 2.0 * kPi * u.y;
  return pixel + ivec2(roundEven(radius * sqrt(u.x) * vec2(cos(angle), sin(angle))));
}

// The reservoirs of alike pixels around one, and their counts together.
uint find_neighbours(ivec2 pixel, out ivec2 found[kMostNeighbours], out float counts) {
  ivec2 size = textureSize(reservoir, 0);
  uint number = 0u;
  counts = 0.0;
  for (uint i = 0u; i < min(neighbours, kMostNeighbours); ++i) {
    ivec2 other = neighbour_of(pixel, i);
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size)) || !is_alike(pixel, other)) continue;
    found[number++] = other;
    counts += unpack_reservoir(texelFetch(reservoir, other, 0)).count;
  }
  return number;
}

Reservoir with_neighbours(Grid grid, ivec2 pixel, Reservoir own) {
  ivec2 found[kMostNeighbours];
  float counts;
  uint number = find_neighbours(pixel, found, counts);
  if (!(counts > 0.0)) return own;
  Merge merge = begin_merge(grid, among_voxels(grid, first_hit(pixel)), own, counts);
  for (uint i = 0u; i < number; ++i) {
    float u = random4(key_of(pixel, i), sequence, kDimensionResample).z;
    PathVertex vertex = among_voxels(grid, first_hit(found[i]));
    merge_other(merge, grid, vertex, unpack_reservoir(texelFetch(reservoir, found[i], 0)), false, u);
  }
  return end_merge(merge, random4(key_of(pixel, 0u), sequence, kDimensionResample).w);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(reservoir, 0)))) return;
  Reservoir own = unpack_reservoir(texelFetch(reservoir, pixel, 0));
  if (has_emissive && own.count > 0.0) own = with_neighbours(scene_grid(textureSize(voxels_albedo, 0)), pixel, own);
  imageStore(out_reservoir, pixel, pack_reservoir(own));
}
