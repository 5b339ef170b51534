// How what each pixel of the G-buffer shows moved over the screen since the last frame.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/filter.glsl"
#include "lib/motion.glsl"
#include "lib/storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D out_surface_position;   // outputs of the draw before
uniform utexture2D out_surface_id;
uniform writeonly image2D out_motion;

layout(constant_id = 0) const float out_motion_largest = 65504.0;

// Direction that a perspective camera sees at a place in clip space. The rows of its matrix that give x, y and w are
// orthogonal; the inverse would lose digits to the ratio of the near and far planes.
vec3 view_direction(vec2 clip) {
  mat4 rows = transpose(frame.view_projection[0]);
  vec3 x = rows[0].xyz, y = rows[1].xyz, w = rows[3].xyz;
  return x * (clip.x / dot(x, x)) + y * (clip.y / dot(y, y)) + w / dot(w, w);
}

// From where a point of homogeneous coordinates is now to where it was, `before` being the point a frame ago [pixels].
vec2 screen_motion(vec4 point, vec4 before, vec2 size) {
  vec4 now = frame.view_projection[0] * point;
  vec4 then = frame.view_projection[1] * before;
  if (!(now.w > 0.0 && then.w > 0.0)) return vec2(0.0);
  return clip_to_pixel(then, size) - clip_to_pixel(now, size);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(out_surface_position, 0);
  if (any(greaterThanEqual(pixel, size))) return;
  vec4 position = texelFetch(out_surface_position, pixel, 0);
  vec2 motion = vec2(0.0);
  if (position.w > 0.0) {
    vec3 before = past_position(texelFetch(out_surface_id, pixel, 0), position.xyz, 1u);
    motion = screen_motion(vec4(position.xyz, 1.0), vec4(before, 1.0), vec2(size));
  } else if (frame.eye[0].w > 0.5) {
    vec4 direction = vec4(view_direction((vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0), 0.0);
    motion = screen_motion(direction, direction, vec2(size));
  }
  imageStore(out_motion, pixel, storable(vec4(frame.ids.z > 0u ? motion : vec2(0.0), 0.0, 0.0), out_motion_largest));
}
