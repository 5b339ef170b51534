// The light sample of each pixel out of many candidates and what the pixel had a frame ago. See
// passes/light_reservoirs.cpp for the ports and params.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Params {
  uint candidates;
  float history;
  float position_tolerance;
  float normal_threshold;
  float reservoir_draws;
};

layout(constant_id = 0) const bool past_bound = false;
layout(constant_id = 1) const bool past_surface_bound = false;
layout(constant_id = 2) const bool moved_bound = false;

uniform utexture2D surface_id;
uniform utexture2D past;
uniform texture2D past_surface_position;
uniform texture2D past_surface_normal;
uniform texture2D past_surface_geometric_normal;
uniform texture2D past_surface_tangent;
uniform texture2D past_surface_albedo;
uniform texture2D past_surface_material;
uniform utexture2D past_surface_id;
uniform utexture2D moved;
uniform writeonly uimage2D out_reservoir;

#include "lib/first_hit.glsl"
#include "lib/reprojection.glsl"
#include "lib/reservoir_merge.glsl"
#include "lib/surface_vertex.glsl"

// Where voxels change, nobody knows what a frame ago could be drawn, unless told.
const bool kLooksBack = past_bound && past_surface_bound && (moved_bound || !has_dynamic);

// Candidates are drawn by the lights' power, each from an equal part of it: all of them together are one draw from the
// whole for the weights, and less noisy. The last 2^32 mod `candidates` of the words are never drawn.
Reservoir choose_candidate(Grid grid, PathVertex vertex, RandomKey key) {
  Stream stream = kEmptyStream;
  uint part = 0xFFFFFFFFu / candidates;
  for (uint i = 0u; i < candidates; ++i) {
    key.path = i;
    uvec4 bits = random_bits(key, 0u, kDimensionCandidate);
    uint within, rest;
    umulExtended(bits.x, part, within, rest);
    uvec4 steps = in_steps(uvec4(i * part + within, bits.yzw));
    FacePoint point = draw_face_point(steps);
    float target = light_target(grid, vertex, point);
    if (!(target > 0.0)) continue;
    int axis = face_axis(point.face);
    // The word that would place the point across its face decides nothing else.
    float u = uniform_floats(bits)[axis + 1];
    add_to_stream(stream, face_code(point.voxel, point.face), pack_place(steps, axis), target,
                  target / (point.probability * float(candidates)), u);
  }
  return reservoir_of(stream, 1.0);
}

Seen seen_in_frame(uint age, ivec2 pixel, uvec4 id) {
  vec4 position = texelFetch(past_surface_position, pixel, 0);
  bool same = position.w > 0.0 && same_material(texelFetch(past_surface_id, pixel, 0), id);
  return Seen(position.xyz, texelFetch(past_surface_normal, pixel, 0).xyz, same);
}

PathVertex past_vertex(Grid grid, ivec2 pixel) {
  SurfaceTexels texels;
  texels.position = texelFetch(past_surface_position, pixel, 0);
  texels.normal = texelFetch(past_surface_normal, pixel, 0);
  texels.geometric_normal = texelFetch(past_surface_geometric_normal, pixel, 0);
  texels.tangent = texelFetch(past_surface_tangent, pixel, 0);
  texels.albedo = texelFetch(past_surface_albedo, pixel, 0);
  texels.material = texelFetch(past_surface_material, pixel, 0);
  return among_voxels(grid, vertex_of_surface(texels, frame.eye[1]));
}

// May the exposed faces of a voxel be others than a frame ago?
bool may_have_changed(ivec3 voxel) {
  if (!has_dynamic || !moved_bound) return false;
  for (int row = 0; row < textureSize(moved, 0).y; ++row) {
    uvec3 end = texelFetch(moved, ivec2(1, row), 0).xyz;
    if (end.x == 0u) return false;
    uvec3 low = texelFetch(moved, ivec2(0, row), 0).xyz;
    if (all(greaterThanEqual(uvec3(voxel), low)) && all(lessThan(uvec3(voxel), end))) return true;
  }
  return false;
}

Reservoir with_past(Grid grid, PathVertex vertex, Reservoir own, ivec2 pixel, RandomKey key) {
  Point point = Point(vertex.position, texelFetch(surface_normal, pixel, 0).xyz, texelFetch(surface_id, pixel, 0));
  ivec2 earlier;
  if (!find_in_frame(1u, past_point(point, 1u), textureSize(surface_position, 0), earlier)) return own;
  Reservoir old = unpack_reservoir(texelFetch(past, earlier, 0));
  old.count = min(old.count, history * own.count);
  if (!(old.count > 0.0)) return own;
  if (may_have_changed(face_voxel(old.code))) old.weight = 0.0;
  Merge merge = begin_merge(grid, vertex, own, old.count);
  vec4 u = random4(key, 0u, kDimensionResample);
  merge_other(merge, grid, past_vertex(grid, earlier), old, may_have_changed(merge.own_point.voxel), u.x);
  return end_merge(merge, u.y);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(surface_position, 0)))) return;
  Reservoir reservoir = kNoReservoir;
  if (has_emissive && is_lit(pixel)) {
    Grid grid = scene_grid(textureSize(voxels_albedo, 0));
    PathVertex vertex = among_voxels(grid, first_hit(pixel));
    RandomKey key = RandomKey(uvec2(pixel), frame.ids.x, frame.ids.y, 0u, 1u);
    reservoir = choose_candidate(grid, vertex, key);
    if (kLooksBack) reservoir = with_past(grid, vertex, reservoir, pixel, key);
  }
  imageStore(out_reservoir, pixel, pack_reservoir(reservoir));
}
