// Pictures of the voxel grid. See passes/view_voxels.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/color.glsl"
#include "lib/grid.glsl"
#include "lib/march.glsl"
#include "lib/view_ray.glsl"
#include "lib/voxel_bits.glsl"
#include "lib/voxel_encoding.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
uniform texture3D distance;
uniform writeonly image2D out_image;

const uint kShowAlbedo = 0u;
const uint kShowNormal = 1u;
const uint kShowTangent = 2u;
const uint kShowMaterial = 3u;
const uint kShowEmission = 4u;
const uint kShowDistance = 5u;
layout(constant_id = 0) const uint show = kShowAlbedo;
layout(constant_id = 1) const uint cut = 0u;   // 0: none, else 1 + axis
layout(constant_id = 2) const bool shade_faces = true;

layout(push_constant) uniform Params {
  float cut_position;
};

const vec3 kNothing = vec3(0.35);

vec3 distance_color(float voxels) {
  return mix(vec3(0.1, 0.15, 0.45), vec3(1.0, 0.93, 0.45), 1.0 - 1.0 / max(voxels, 1.0));
}

vec3 voxel_color(ivec3 voxel) {
  vec4 material = texelFetch(voxels_material, voxel, 0);
  VoxelSurface surface = decode_voxel(texelFetch(voxels_albedo, voxel, 0), texelFetch(voxels_normal, voxel, 0), material,
                                      voxels_normal_bits);
  if (show == kShowNormal) return surface.normal * 0.5 + 0.5;
  if (show == kShowTangent) return surface.tangent * 0.5 + 0.5;
  if (show == kShowMaterial) return material.rgb;
  if (show == kShowEmission) return id_color(surface.emission);
  return encode_srgb(surface.albedo);
}

// Mean of the distances at each unit of length before the hit, or before the ray leaves the grid.
float mean_distance(ViewRay ray, MarchHit hit, ivec3 extent) {
  vec3 near, far;
  box_slabs(ray.origin, ray.direction, vec3(extent), near, far);
  float first = max(greatest_of(near), 0.0);
  float last = hit.hit ? hit.t : least_of(far);
  vec2 sum = vec2(0.0);
  int limit = extent.x + extent.y + extent.z;
  for (int k = 0; k < limit && first + float(k) < last; ++k) {
    ivec3 voxel = ivec3(floor(ray.origin + ray.direction * (first + float(k))));
    if (within(voxel, extent)) sum += vec2(float(voxel_distance(distance, voxel)), 1.0);
  }
  return sum.x / max(sum.y, 1.0);
}

vec3 through_camera(ivec2 pixel, ivec2 size) {
  ivec3 extent = textureSize(voxels_albedo, 0);
  Grid grid = scene_grid(extent);
  ViewRay ray = view_ray(pixel, size);
  ray.origin = world_to_grid(grid, ray.origin);
  MarchHit hit = march_ray(distance, ray.origin, ray.direction, kFarAway);
  if (show == kShowDistance) return distance_color(mean_distance(ray, hit, extent));
  if (!hit.hit) return kNothing;
  float shade = shade_faces ? dot(abs(vec3(hit.face)), vec3(0.82, 1.0, 0.66)) : 1.0;
  return shade * voxel_color(hit.voxel);
}

vec3 slice(ivec2 pixel, ivec2 size) {
  ivec3 extent = textureSize(voxels_albedo, 0);
  int axis = int(cut) - 1;
  int right = axis == 0 ? 2 : 0;
  int up = axis == 1 ? 2 : 1;
  float texels = min(float(size.x) / float(extent[right]), float(size.y) / float(extent[up]));
  vec2 place = (vec2(pixel) + 0.5 - 0.5 * vec2(size)) / texels + 0.5 * vec2(extent[right], extent[up]);
  ivec3 voxel;
  voxel[axis] = min(int(cut_position * float(extent[axis])), extent[axis] - 1);
  voxel[right] = int(floor(place.x));
  voxel[up] = int(floor(axis == 1 ? place.y : float(extent[up]) - place.y));
  if (!within(voxel, extent)) return kNothing;
  if (show == kShowDistance) {
    int empty = voxel_distance(distance, voxel);
    return empty > 0 ? distance_color(float(empty)) : vec3(0.0);
  }
  return voxel_occupied(texelFetch(voxels_albedo, voxel, 0)) ? voxel_color(voxel) : kNothing;
}

void main() {
  ivec2 size = imageSize(out_image);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  imageStore(out_image, pixel, vec4(cut == 0u ? through_camera(pixel, size) : slice(pixel, size), 1.0));
}
