#version 460
#extension GL_GOOGLE_include_directive : require
#include "integer.glsl"
uniform utexture2D x;
layout(r32ui) uniform uimage2D hits;
layout(push_constant) uniform Params { uint salt; };
void main() { imageAtomicMax(hits, ivec2(gl_FragCoord.xy), mixed(salt, texelFetch(x, ivec2(gl_FragCoord.xy), 0).r)); }
