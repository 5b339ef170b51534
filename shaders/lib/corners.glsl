// Geometry of one triangle.
#ifndef LIGHTLOOM_LIB_CORNERS
#define LIGHTLOOM_LIB_CORNERS

// Corners; in which units, the user says.
struct Corners {
  vec3 a;
  vec3 b;
  vec3 c;
};

// Twice the area, along the normal of the front face (counter-clockwise corners).
vec3 area_normal(Corners t) { return cross(t.b - t.a, t.c - t.a); }

// Is it more than a line or a point? The bound of scene::is_degenerate; false also for corners that are not numbers.
// Clipping and rounding would make a sliver of a line, with pixels of its own.
bool has_area(Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 area = abs(cross(ab, ac));
  return max(area.x, max(area.y, area.z)) > 1e-9 * max(dot(ab, ab), dot(ac, ac));
}

// Barycentric coordinates of the triangle's point nearest to `p`. Ericson 2005, "Real-Time Collision Detection", 5.1.5:
// the Voronoi region of p (corner, edge or face) is found from dot products alone. A triangle without area gives a
// point of it, never NaN.
vec3 nearest_barycentric(vec3 p, Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 ap = p - t.a;
  float ap_ab = dot(ab, ap);
  float ap_ac = dot(ac, ap);
  if (ap_ab <= 0.0 && ap_ac <= 0.0) return vec3(1.0, 0.0, 0.0);
  vec3 bp = p - t.b;
  float bp_ab = dot(ab, bp);
  float bp_ac = dot(ac, bp);
  if (bp_ab >= 0.0 && bp_ac <= bp_ab) return vec3(0.0, 1.0, 0.0);
  vec3 cp = p - t.c;
  float cp_ab = dot(ab, cp);
  float cp_ac = dot(ac, cp);
  if (cp_ac >= 0.0 && cp_ab <= cp_ac) return vec3(0.0, 0.0, 1.0);
  float area_c = ap_ab * bp_ac - bp_ab * ap_ac;
  if (area_c <= 0.0 && ap_ab >= 0.0 && bp_ab <= 0.0) {
    float v = ap_ab / max(ap_ab - bp_ab, 1e-30);
    return vec3(1.0 - v, v, 0.0);
  }
  float area_b = cp_ab * ap_ac - ap_ab * cp_ac;
  if (area_b <= 0.0 && ap_ac >= 0.0 && cp_ac <= 0.0) {
    float w = ap_ac / max(ap_ac - cp_ac, 1e-30);
    return vec3(1.0 - w, 0.0, w);
  }
  float area_a = bp_ab * cp_ac - cp_ab * bp_ac;
  float towards_c = bp_ac - bp_ab;
  float towards_b = cp_ab - cp_ac;
  if (area_a <= 0.0 && towards_c >= 0.0 && towards_b >= 0.0) {
    float w = towards_c / max(towards_c + towards_b, 1e-30);
    return vec3(0.0, 1.0 - w, w);
  }
  float total = area_a + area_b + area_c;
  if (!(total > 0.0)) return vec3(1.0, 0.0, 0.0);
  return vec3(area_a, area_b, area_c) / total;
}

#endif
