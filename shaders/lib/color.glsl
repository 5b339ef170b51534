// Colour, linear with the primaries of sRGB (ITU-R BT.709).
#ifndef LIGHTLOOM_LIB_COLOR
#define LIGHTLOOM_LIB_COLOR

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

// Display values of linear ones from 0 to 1 (IEC 61966-2-1).
vec3 encode_srgb(vec3 x) {
  return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

// A colour for a number, neighbours far apart: the hue goes on by the golden section. 0 is black.
vec3 id_color(uint id) {
  if (id == 0u) return vec3(0.0);
  float hue = fract(float(id & 0xFFFFu) * 0.61803399);
  vec3 ramp = abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0;
  float value = 1.0 - 0.35 * float((id * 2654435761u) >> 30u) / 3.0;
  return value * mix(vec3(1.0), clamp(ramp, 0.0, 1.0), 0.7);
}

#endif
