#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
uniform utexture2D x;
layout(push_constant) uniform Params { uint salt; };
out uint out_a;
void main() { out_a = mixed(salt, texelFetch(x, ivec2(gl_FragCoord.xy), 0).r); }
