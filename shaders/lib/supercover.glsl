// Which voxels a triangle touches. Schwarz and Seidel 2010, "Fast Parallel Surface and Solid Voxelization on GPUs",
// section 4: box of the triangle, plane, and the three projections' edges. The triangle is seen along the axis its
// normal is closest to: a column of voxels along it holds only few candidates, so cost grows with the area, not with
// the box.
//
// All in grid units. `margin` widens each voxel against rounding, so that no touched voxel is ever missed.
#ifndef LIGHTLOOM_LIB_SUPERCOVER
#define LIGHTLOOM_LIB_SUPERCOVER

#include "lib/corners.glsl"

struct Supercover {
  int axis;          // of the columns
  Corners corners;   // coordinates turned so that z is the axis
  vec3 normal;       // not normalised, turned
  ivec3 low;         // voxels of the triangle's box within the grid, turned; empty if any low > high
  ivec3 high;
  float margin;      // [voxels]
  float slack;       // the same for the plane, whose normal is rounded worse, the narrower the triangle [voxels]
};

// Turns coordinates so that `axis` becomes z; the order x, y, z stays cyclic.
vec3 turn(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }
ivec3 turn(ivec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }
ivec3 turn_back(ivec3 v, int axis) { return axis == 0 ? v.zxy : axis == 1 ? v.yzx : v; }

Supercover make_supercover(Corners t, ivec3 extent) {
  Supercover s;
  s.margin = 4e-7 * float(max(extent.x, max(extent.y, extent.z)));
  vec3 normal = area_normal(t);
  vec3 size = abs(normal);
  s.axis = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
  s.corners = Corners(turn(t.a, s.axis), turn(t.b, s.axis), turn(t.c, s.axis));
  s.normal = turn(normal, s.axis);
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  float size_squared = max(dot(ab, ab), dot(ac, ac));
  // Rounding of a cross product is relative to the edges' lengths, and tilts the plane over the triangle's length.
  s.slack = s.margin + 4e-7 * size_squared * sqrt(size_squared) / max(abs(turn(normal, s.axis).z), 1e-30);
  vec3 low = min(s.corners.a, min(s.corners.b, s.corners.c)) - s.margin;
  vec3 high = max(s.corners.a, max(s.corners.b, s.corners.c)) + s.margin;
  vec3 last = vec3(turn(extent, s.axis) - 1);
  // A voxel is touched at its upper face too, hence ceil - 1. Clamped as floats: far corners do not fit integers.
  s.low = ivec3(clamp(ceil(low) - 1.0, vec3(0.0), last + 1.0));
  s.high = ivec3(clamp(floor(high), vec3(-1.0), last));
  return s;
}

uint column_count(Supercover s) {
  ivec2 size = max(s.high.xy - s.low.xy + 1, ivec2(0));
  return s.low.z > s.high.z ? 0u : uint(size.x) * uint(size.y);
}

ivec2 column(Supercover s, uint index) {
  uint width = uint(s.high.x - s.low.x + 1);
  return s.low.xy + ivec2(index % width, index / width);
}

// Is a unit square around `center` on the inner side of the edge from p to q, or touched by it? `side`: 1 if the
// projected triangle runs counter-clockwise, else -1.
bool edge_accepts(vec2 p, vec2 q, vec2 center, float side, float margin) {
  vec2 inward = vec2(p.y - q.y, q.x - p.x) * side;
  return dot(inward, center - p) + (0.5 + margin) * (abs(inward.x) + abs(inward.y)) >= 0.0;
}

bool square_touched(vec2 a, vec2 b, vec2 c, vec2 center, float side, float margin) {
  return edge_accepts(a, b, center, side, margin) && edge_accepts(b, c, center, side, margin) &&
         edge_accepts(c, a, center, side, margin);
}

bool column_touched(Supercover s, ivec2 where) {
  float side = s.normal.z >= 0.0 ? 1.0 : -1.0;
  return square_touched(s.corners.a.xy, s.corners.b.xy, s.corners.c.xy, vec2(where) + 0.5, side, s.margin);
}

// Of the triangle's plane: change of z along x and along y, each at most 1 by the choice of the axis.
vec2 plane_slope(Supercover s) { return -s.normal.xy * (sign(s.normal.z) / max(abs(s.normal.z), 1e-30)); }

// First and last voxel of a column between which the triangle's plane passes through it.
ivec2 column_span(Supercover s, ivec2 where) {
  float steepness = max(abs(s.normal.z), 1e-30);
  vec2 offset = vec2(where) + 0.5 - s.corners.a.xy;
  float middle = s.corners.a.z + dot(plane_slope(s), offset);
  float reach = (0.5 + s.margin) * (abs(s.normal.x) + abs(s.normal.y)) / steepness + s.slack;
  return ivec2(clamp(ceil(middle - reach) - 1.0, float(s.low.z), float(s.high.z) + 1.0),
               clamp(floor(middle + reach), float(s.low.z) - 1.0, float(s.high.z)));
}

// Rest of the test for a voxel of a touched column's span: the other two projections.
bool voxel_touched(Supercover s, ivec3 where) {
  vec3 center = vec3(where) + 0.5;
  float side_x = s.normal.x >= 0.0 ? 1.0 : -1.0;
  float side_y = s.normal.y >= 0.0 ? 1.0 : -1.0;
  return square_touched(s.corners.a.yz, s.corners.b.yz, s.corners.c.yz, center.yz, side_x, s.margin) &&
         square_touched(s.corners.a.zx, s.corners.b.zx, s.corners.c.zx, center.zx, side_y, s.margin);
}

#endif
