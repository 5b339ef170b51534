// Colour, linear with the primaries of sRGB (ITU-R BT.709).
#ifndef LIGHTLOOM_LIB_COLOR
#define LIGHTLOOM_LIB_COLOR

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

#endif
