// What the pass `distance_transform` leaves in a voxel.
#ifndef LIGHTLOOM_LIB_VOXEL_DISTANCE
#define LIGHTLOOM_LIB_VOXEL_DISTANCE

// Distance to the nearest occupied voxel, 0 in one.
int voxel_distance(texture3D distance_field, ivec3 voxel) {
  return int(round(texelFetch(distance_field, voxel, 0).r * 255.0));
}

#endif
