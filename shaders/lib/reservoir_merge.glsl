// Merging the reservoirs of other pixels, of this frame or the last, into that of a pixel.
#ifndef LIGHTLOOM_LIB_RESERVOIR_MERGE
#define LIGHTLOOM_LIB_RESERVOIR_MERGE

#include "lib/reservoir_target.glsl"

struct Merge {
  PathVertex vertex;
  Reservoir own;
  FacePoint own_point;
  float own_target;
  float own_share;   // so far
  float others;      // counts of all others together
  Stream stream;
};

// `others`: counts of all reservoirs that are going to be merged, together.
Merge begin_merge(Grid grid, PathVertex vertex, Reservoir own, float others) {
  FacePoint point = face_point_of(own);
  return Merge(vertex, own, point, light_target(grid, vertex, point), own.count / (own.count + others), others,
               kEmptyStream);
}

// `vertex`: that of the other pixel, when it was seen. `fresh`: could the other pixel not know what the own sample is, as
// it was not there then? `u`: uniform.
void merge_other(inout Merge merge, Grid grid, PathVertex vertex, Reservoir other, bool fresh, float u) {
  float part = other.count / (merge.own.count + merge.others);
  float target_there = fresh ? 0.0 : light_target(grid, vertex, merge.own_point);
  merge.own_share += part * own_pair_share(merge.own.count, merge.own_target, merge.others, target_there);
  FacePoint point = face_point_of(other);
  float target = light_target(grid, merge.vertex, point);
  if (!(target > 0.0)) return;
  float share =
      part * other_pair_share(merge.own.count, target, merge.others, light_target(grid, vertex, point));
  add_to_stream(merge.stream, other.code, other.place, target, share * target * other.weight, u);
}

// `u`: uniform.
Reservoir end_merge(Merge merge, float u) {
  Reservoir own = merge.own;
  add_to_stream(merge.stream, own.code, own.place, merge.own_target, merge.own_share * merge.own_target * own.weight, u);
  return reservoir_of(merge.stream, own.count + merge.others);
}

#endif
