// Where a path meets a voxel.
#ifndef LIGHTLOOM_LIB_VOXEL_VERTEX
#define LIGHTLOOM_LIB_VOXEL_VERTEX

#include "lib/grid.glsl"
#include "lib/march.glsl"
#include "lib/path_vertex.glsl"
#include "lib/ray_start.glsl"
#include "lib/voxel_bits.glsl"
#include "lib/voxel_encoding.glsl"

// Voxel normals are 0.8 degrees off and tangents up to 10: a sharper lobe would only turn that into speckle.
const float kVoxelMinimumAlpha = 0.03;

VoxelSurface surface_of(texture3D albedo, texture3D normal, texture3D material, ivec3 voxel) {
  return decode_voxel(texelFetch(albedo, voxel, 0), texelFetch(normal, voxel, 0), texelFetch(material, voxel, 0),
                      voxels_normal_bits);
}

// Does a ray meet the side to which the normal points?
bool meets_front(VoxelSurface surface, vec3 direction) { return dot(surface.normal, direction) <= 0.0; }

PathVertex voxel_vertex(Grid grid, MarchHit hit, vec3 origin, vec3 direction, VoxelSurface surface,
                        float least_alpha) {
  PathVertex vertex;
  bool front = meets_front(surface, direction);
  vec3 normal = front ? surface.normal : -surface.normal;
  // The march stops anywhere inside the voxel. The centre is the best guess at the depth of the surface; sideways the
  // position is kept, or light would come in blocks. Off the centre, 1.5 clearances leave the voxels of a plane.
  vec3 hit_position = origin + direction * hit.t;
  vec3 centre = vec3(hit.voxel) + 0.5;
  vec3 position = hit_position + normal * dot(normal, centre - hit_position);
  vertex.position = grid_to_world(grid, position);
  // A normal that faces away may be that of the other wall of an edge, and its back the outside of the room: then the
  // path goes on from the last place that was empty.
  vec3 lifted = start == kStartSqrt3 ? hit_position + normal * start_offset(normal)
                                     : position + normal * (1.5 * surface_clearance(normal));
  vertex.origin = front ? lifted : origin + direction * max(hit.t - 1.0, 0.0);
  vertex.geometric_normal = normal;
  vertex.basis = make_frame(facing_normal(normal, -direction), surface.tangent);
  vertex.incoming = to_local(vertex.basis, -direction);
  vec2 alpha = max(surface.ward_alpha, vec2(least_alpha));
  vertex.bsdf = Bsdf(surface.albedo, surface.metallic, surface.f0, surface.f90, alpha);
  return vertex;
}

// Share of light from everywhere that the vertex scatters back along the path.
vec3 albedo_towards(PathVertex vertex) {
  vec3 albedo = diffuse_albedo(vertex.bsdf, vertex.incoming.z);
  return has_specular ? albedo + specular_fresnel(vertex.bsdf, vertex.incoming.z) : albedo;
}

#endif
