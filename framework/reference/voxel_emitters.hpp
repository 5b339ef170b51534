#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "framework/reference/voxel_grid.hpp"
#include "framework/scene/lights.hpp"

namespace lightloom::reference {

/// Light of the exposed faces of emissive voxels, which are all that a ray can meet of them. Draws points on them: a
/// face in proportion to the luminance that it sends out, a point uniformly on it.
class VoxelEmitters {
 public:
  /// `entries`: the scene's emission table, by which voxels name what they emit. `areas`: where not empty, the area of
  /// each entry's triangles [m^2]; the entry's voxels then have as much power together as its triangles, but no more
  /// than four times the triangles' radiance. Keeps references to all.
  VoxelEmitters(const VoxelGrid& grid, std::span<const scene::EmissionEntry> entries, std::span<const float> areas);

  [[nodiscard]] bool empty() const { return faces_.empty(); }
  /// Radiance that a voxel sends against a ray of the given direction [W m^-2 sr^-1].
  [[nodiscard]] glm::vec3 radiance(const Voxel& voxel, const glm::vec3& direction) const;

  struct Sample {
    glm::dvec3 point{0};  ///< [voxels]
    glm::ivec3 voxel{0};
    glm::dvec3 normal{0};  ///< outward, of the face
    double density = 0;    ///< over the face's area [voxels^-2]
  };
  [[nodiscard]] Sample sample(const glm::vec2& pick, const glm::vec2& point) const;
  /// Density of the points on the face of a voxel [voxels^-2].
  [[nodiscard]] double density(const Voxel& voxel, int axis, int side) const;

 private:
  struct Face {
    glm::ivec3 voxel{0};
    int axis = 0, side = 0;
  };
  /// Power of a face over that of one that emits into its whole hemisphere.
  [[nodiscard]] double share(const Voxel& voxel, int axis, int side) const;
  [[nodiscard]] double weight(const Voxel& voxel, int axis, int side) const;
  void find_faces();
  void match_power(std::span<const float> areas);

  const VoxelGrid& grid_;
  std::span<const scene::EmissionEntry> entries_;
  std::vector<float> scales_;  ///< of the radiance, by entry
  std::vector<Face> faces_;
  std::vector<double> cumulative_;  ///< weights up to and including each face
};

}  // namespace lightloom::reference
