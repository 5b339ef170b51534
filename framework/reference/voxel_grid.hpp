#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "framework/reference/bsdf.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::reference {

/// The images of a voxel grid (bundle `voxels`): four channels a voxel, of 8 bits or of 16 (low byte first), x fastest,
/// then y, then z.
struct VoxelImages {
  glm::ivec3 extent{1};
  std::span<const uint8_t> albedo, normal, material;
  uint32_t albedo_bits = 8, normal_bits = 8, material_bits = 8;
};

/// What a voxel holds.
struct Voxel {
  glm::vec3 normal{0, 1, 0};   ///< unit, of the front face
  glm::vec3 tangent{1, 0, 0};  ///< unit, orthogonal to the normal: the lobe's x axis
  Reflectance reflectance;
  uint32_t emission = 0;  ///< index into the emission table; 0: none
};

/// A grid of voxels around a scene's bounds; the longest side of the bounds fits, with one voxel of padding at each
/// end. Places are in voxels: voxel (i, j, k) is the unit cube from (i, j, k) on. All in double precision.
class VoxelGrid {
 public:
  /// Keeps the spans of `images`. Throws Error (invalid_input) where they do not have the size of the extent.
  VoxelGrid(const VoxelImages& images, const scene::Bounds& bounds);

  struct Hit {
    glm::ivec3 voxel{0};
    double t = 0;   ///< where the ray enters the voxel [voxels]; 0 if it starts there
    int axis = -1;  ///< of the face through which it enters; -1 if it starts there
    int side = 0;   ///< -1 or 1: which of the two faces of the axis
  };
  /// The first occupied voxel that a ray touches up to `end` voxels (Amanatides and Woo 1987); `direction` is a unit
  /// vector. Outside the grid all is empty.
  [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& origin, const glm::dvec3& direction,
                                             double end = std::numeric_limits<double>::infinity()) const;

  [[nodiscard]] const glm::ivec3& extent() const { return images_.extent; }
  [[nodiscard]] double voxel_size() const { return voxel_size_; }  ///< [m]
  [[nodiscard]] bool occupied(const glm::ivec3& voxel) const { return inside(voxel) && occupied_[index(voxel)] != 0; }
  [[nodiscard]] size_t index(const glm::ivec3& voxel) const {
    return (static_cast<size_t>(voxel.z) * images_.extent.y + voxel.y) * images_.extent.x + voxel.x;
  }
  [[nodiscard]] Voxel decode(const glm::ivec3& voxel) const;
  [[nodiscard]] glm::dvec3 to_grid(const glm::vec3& world) const { return (glm::dvec3(world) - origin_) / voxel_size_; }
  [[nodiscard]] glm::vec3 to_world(const glm::dvec3& place) const { return glm::vec3(origin_ + place * voxel_size_); }

  /// Channels of a voxel in one of the images, as they are stored.
  using Texel = std::array<uint32_t, 4>;

 private:
  [[nodiscard]] static Texel texel(std::span<const uint8_t> image, uint32_t bits, size_t index);
  [[nodiscard]] bool inside(const glm::ivec3& voxel) const {
    return glm::all(glm::greaterThanEqual(voxel, glm::ivec3(0))) && glm::all(glm::lessThan(voxel, images_.extent));
  }

  VoxelImages images_;
  glm::dvec3 origin_{0};  ///< low corner of voxel (0, 0, 0) [m]
  double voxel_size_ = 1;
  std::vector<uint8_t> occupied_;
};

}  // namespace lightloom::reference
