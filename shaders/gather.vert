// Corners of what has no holes.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/gather_vertex.glsl"
#include "lib/material.glsl"

layout(location = 0) flat out uint triangle;   // index + 1

void main() {
  uint index = uint(gl_VertexIndex) / 3u;
  Triangle t = triangle_at(index);
  triangle = index + 1u;
  gl_Position = alpha_masked(t.material) ? kNowhere : clip_position(t, uint(gl_VertexIndex) % 3u);
}
