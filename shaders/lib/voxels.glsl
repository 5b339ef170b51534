// The voxels that a pass reads: see passes/bundles.hpp.
#ifndef LIGHTLOOM_LIB_VOXELS
#define LIGHTLOOM_LIB_VOXELS

uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;

#endif
