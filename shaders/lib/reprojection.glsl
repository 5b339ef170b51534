// Which pixel of an earlier frame shows the point that a pixel of this one shows. Whoever includes this declares the push
// constants `position_tolerance` and `normal_threshold`, and says what earlier frames saw.
#ifndef LIGHTLOOM_LIB_REPROJECTION
#define LIGHTLOOM_LIB_REPROJECTION

#include "lib/filter.glsl"
#include "lib/motion.glsl"
#include "lib/scene.glsl"

// The point of the surface that a pixel shows, in one frame.
struct Point {
  vec3 position;   // [m]
  vec3 normal;
  uvec4 id;
};

// What an earlier frame saw in a pixel.
struct Seen {
  vec3 position;   // [m]
  vec3 normal;
  bool same;       // a surface, and of the same object and material
};

// By the shader that includes this: from how its trails are stored.
Seen seen_in_frame(uint age, ivec2 pixel, uvec4 id);

bool same_material(uvec4 a, uvec4 b) { return a.xy == b.xy; }

Point past_point(Point point, uint age) {
  return Point(past_position(point.id, point.position, age), past_normal(point.id, point.normal, age), point.id);
}

// Does `seen`, which frame `age` saw in the pixel that `point` falls into, lie on the surface of `point`? `clip_w` is
// the clip coordinate of `point` in that frame.
bool lies_on(Point point, vec3 seen, uint age, float clip_w, vec2 size) {
  // The nearest pixel's centre lies up to a footprint away on the plane of the surface, more where that is slanted;
  // off the plane it should not lie at all.
  vec3 offset = seen - point.position;
  vec3 to_viewer = normalize(frame.eye[age].xyz - point.position * frame.eye[age].w);
  float tolerance = position_tolerance * pixel_footprint(frame.view_projection[age], clip_w, size);
  float slant = max(abs(dot(point.normal, to_viewer)), 0.05);
  return abs(dot(offset, point.normal)) <= tolerance && dot(offset, offset) <= tolerance * tolerance / (slant * slant);
}

// Did the frame `age` frames ago see this point? If so, `pixel` is where.
bool find_in_frame(uint age, Point point, ivec2 size, out ivec2 pixel) {
  pixel = ivec2(0);
  vec4 clip = frame.view_projection[age] * vec4(point.position, 1.0);
  if (!(clip.w > 0.0)) return false;
  vec2 place = clip_to_pixel(clip, vec2(size));
  if (!(all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(size))))) return false;
  pixel = min(ivec2(place), size - 1);
  Seen seen = seen_in_frame(age, pixel, point.id);
  if (!seen.same || !(dot(seen.normal, point.normal) >= normal_threshold)) return false;
  return lies_on(point, seen.position, age, clip.w, vec2(size));
}

#endif
