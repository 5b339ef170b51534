// The triangle that a pixel shows, unless it has a hole there.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/material.glsl"

layout(location = 0) flat in uvec2 ids;
layout(location = 1) in vec4 texcoords;
layout(location = 2) in float alpha;

layout(location = 0) out uint visibility;

void main() {
  TexturePoint point = TexturePoint(texcoords, dFdx(texcoords), dFdy(texcoords));
  if (cut_out(ids.y, material_alpha(ids.y, point, vec4(1.0, 1.0, 1.0, alpha)))) discard;
  visibility = ids.x;
}
