// What the shaders of the pass `emissive_faces` share. Columns of voxels run along z and rows of columns along x; what is
// known of each is kept from frame to frame, so that only what moved is looked at again.
#ifndef LIGHTLOOM_LIB_EMISSIVE_COLUMNS
#define LIGHTLOOM_LIB_EMISSIVE_COLUMNS

#include "lib/emissive_faces.glsl"
#include "lib/features.glsl"
#include "lib/voxel_bits.glsl"

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
layout(rg32ui) uniform uimage2D columns;   // by x, y: number of faces, sum of their weights
layout(r32ui) uniform uimage2D spans;      // by x, y: where the emissive voxels are, first | end << 16; 0: none
layout(r32ui) uniform uimage2D rows;       // by y and one of the lines below

const int kRowDirty = 0;    // does it have to be counted again?
const int kRowFaces = 1;    // number of faces
const int kRowWeight = 2;   // sum of their weights
const int kRowFirst = 3;    // number of faces in the rows before
const int kRowBefore = 4;   // sum of their weights
const int kState = 5;       // of the whole list, by one of the following

const int kFirstRow = 0;    // the first row whose part of the list changes; kNoRow: none does
const int kFaces = 1;       // number of faces now
const int kOldFaces = 2;    // and in the frame before
const uint kNoRow = 0xFFFFFFFFu;

uint row_value(int line, int y) { return imageLoad(rows, ivec2(y, line)).x; }
void set_row(int line, int y, uint value) { imageStore(rows, ivec2(y, line), uvec4(value, 0u, 0u, 0u)); }

ivec2 column_span(ivec2 column) {
  uint span = imageLoad(spans, column).x;
  return ivec2(span & 0xFFFFu, span >> 16u);
}

uint emission_at(ivec3 voxel) { return from_unorm(texelFetch(voxels_material, voxel, 0).a); }

// The first voxel from z on, before `end`, that has an emission. Few have: a device that runs a branch for all its lanes
// as soon as one takes it (on a CPU: always) would pay for the faces of all of them; so there is only the cheap search
// between them.
int next_emissive(ivec2 column, int z, int end) {
  while (has_emissive && z < end && emission_at(ivec3(column, z)) == 0u) ++z;
  return has_emissive ? z : end;
}

vec3 normal_at(ivec3 voxel) { return decode_voxel_normal(texelFetch(voxels_normal, voxel, 0), voxels_normal_bits); }

bool exposed(ivec3 voxel, uint face) { return voxel_is_empty(voxels_albedo, voxel + face_normal(face)); }

#endif
