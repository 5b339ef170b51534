// Vertices of the G-buffer by vertex pulling. All three corners of a triangle compute the same face, so nothing about
// it needs derivatives.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/basis.glsl"
#include "lib/triangle.glsl"

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec4 texcoords;
layout(location = 4) out vec4 color;
layout(location = 5) flat out vec3 face_normal;   // unit, of the front face
layout(location = 6) flat out uvec3 ids;          // material, object, triangle
layout(location = 7) flat out uint back;          // 1: the viewer sees the back
layout(location = 8) out vec2 weights;            // barycentric, of corners b and c

void main() {
  uint index = uint(gl_VertexIndex) / 3u;
  uint corner = uint(gl_VertexIndex) % 3u;
  Triangle t = triangles[index];
  Corners corners = world_corners(t);
  uint vertex = corner == 0u ? t.a : corner == 1u ? t.b : t.c;

  position = corner == 0u ? corners.a : corner == 1u ? corners.b : corners.c;
  normal = vertex_normal(vertex);
  tangent = vec4(vertex_tangent(vertex).xyz, vertex_tangent(t.a).w);
  texcoords = vertex_texcoords(vertex);
  color = vertex_color(vertex);
  face_normal = safe_normalize(area_normal(corners), vec3(0.0, 1.0, 0.0));
  ids = uvec3(t.material, t.object, index);
  weights = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
  vec3 to_viewer = frame.eye[0].xyz - corners.a * frame.eye[0].w;
  back = dot(face_normal, to_viewer) < 0.0 ? 1u : 0u;

  gl_Position = frame.view_projection[0] * vec4(position, 1.0);
  // The back of a single-sided material: three equal corners leave no pixels.
  bool unseen = back == 1u && materials[t.material].flags.y == 0u;
  if (unseen || !has_area(corners)) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}
