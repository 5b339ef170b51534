// What is drawn from a list of faces at the ends of the random numbers: of each draw the index that was found, whether
// the face has a weight, and the probability of the draw. Second row: densities of points that light must not come from.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/emitters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly image2D out_draws;

// 0, the least above it, a half, 1 - 2^-24 and the last of 32 bits.
const uint words[5] = uint[5](0u, 1u, 0x80000000u, 0xFFFFFF00u, 0xFFFFFFFFu);

// Touched, closer than it is clear of the surface, in its own plane, turned away, and all but in its own plane.
const vec2 distance_and_cosine[5] = vec2[5](vec2(0.0, 0.5), vec2(1e-5, 0.5), vec2(1.0, 0.0), vec2(1.0, -0.5), vec2(1.0, 1e-7));

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_draws)))) return;
  if (place.y == 1) {
    vec2 point = distance_and_cosine[place.x];
    imageStore(out_draws, place, vec4(face_solid_angle_pdf(0.25, point.x, point.y)));
    return;
  }
  uvec2 head = texelFetch(faces, ivec2(0), 0).rg;
  uint target, rest;
  umulExtended(words[place.x], head.y, target, rest);
  uint found = find_face(head.x, target);
  uint before = found > 1u ? texelFetch(faces, face_texel(found - 1u), 0).g : 0u;
  uint weight = texelFetch(faces, face_texel(found), 0).g - before;
  imageStore(out_draws, place, vec4(float(found), float(weight), float(weight) / float(head.y), float(head.x)));
}
