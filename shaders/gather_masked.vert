// Corners of what may have holes.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/gather_vertex.glsl"
#include "lib/material.glsl"

layout(location = 0) flat out uvec2 ids;   // index of the triangle + 1, material
layout(location = 1) out vec4 texcoords;
layout(location = 2) out float alpha;      // of the vertex colour

void main() {
  uint index = uint(gl_VertexIndex) / 3u;
  uint corner = uint(gl_VertexIndex) % 3u;
  Triangle t = triangle_at(index);
  uint vertex = corner_vertex(t, corner);
  ids = uvec2(index + 1u, t.material);
  texcoords = vertex_texcoords(vertex);
  alpha = vertex_color(vertex).a;
  gl_Position = alpha_masked(t.material) ? clip_position(t, corner) : kNowhere;
}
