// A made-up list of faces as `emissive_faces` leaves them: texel 0 the head, then one texel for each face with the sum of
// the weights up to it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/emissive_faces.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly uimage2D out_faces;

layout(push_constant) uniform Params {
  uint count;      // faces in the list
  uint leading;    // of them, how many at the start weigh nothing
  uint trailing;   // and how many at the end
  uint weight;     // of each of the others
};

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_faces)))) return;
  uint index = uint(place.y * kFaceRow + place.x);
  uint end = count - trailing;
  uint before = min(index, end);
  uint sum = before > leading ? (before - leading) * weight : 0u;
  uvec2 texel = index == 0u ? uvec2(count, (end - leading) * weight) : index <= count ? uvec2(index, sum) : uvec2(0u);
  imageStore(out_faces, place, uvec4(texel, 0u, 0u));
}
