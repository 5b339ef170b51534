#include "framework/reference/voxel_emitters.hpp"

#include <algorithm>

namespace lightloom::reference {
namespace {

double luminance(const glm::vec3& rgb) {
  return glm::dot(glm::dvec3(rgb), glm::dvec3(0.2126, 0.7152, 0.0722));
}

}  // namespace

VoxelEmitters::VoxelEmitters(const VoxelGrid& grid, std::span<const scene::EmissionEntry> entries,
                             std::span<const float> areas)
    : grid_(grid), entries_(entries), scales_(entries.size(), 1.0f) {
  find_faces();
  if (!areas.empty()) match_power(areas);
  double sum = 0;
  for (const Face& face : faces_) cumulative_.push_back(sum += weight(grid_.decode(face.voxel), face.axis, face.side));
}

void VoxelEmitters::find_faces() {
  const glm::ivec3 extent = grid_.extent();
  for (int z = 0; z < extent.z; ++z)
    for (int y = 0; y < extent.y; ++y)
      for (int x = 0; x < extent.x; ++x) {
        const glm::ivec3 voxel(x, y, z);
        if (!grid_.occupied(voxel)) continue;
        const Voxel content = grid_.decode(voxel);
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {-1, 1}) {
            glm::ivec3 neighbour = voxel;
            neighbour[axis] += side;
            if (!grid_.occupied(neighbour) && weight(content, axis, side) > 0) faces_.push_back({voxel, axis, side});
          }
      }
}

void VoxelEmitters::match_power(std::span<const float> areas) {
  std::vector<double> in_voxels(entries_.size(), 0.0);
  for (const Face& face : faces_) {
    const Voxel voxel = grid_.decode(face.voxel);
    in_voxels[voxel.emission] += share(voxel, face.axis, face.side);
  }
  for (size_t entry = 0; entry < entries_.size(); ++entry) {
    if (!(in_voxels[entry] > 0)) continue;
    const double surface = static_cast<double>(areas[entry]) * (entries_[entry].two_sided ? 2 : 1) /
                           (grid_.voxel_size() * grid_.voxel_size());
    scales_[entry] = static_cast<float>(std::min(surface / in_voxels[entry], 4.0));
  }
}

double VoxelEmitters::share(const Voxel& voxel, int axis, int side) const {
  if (entries_[voxel.emission].two_sided) return 1;
  // Only directions above the emitter's own plane count, and of those the face sees pi (1 + cosine) / 2.
  return std::clamp(0.5 + 0.5 * static_cast<double>(voxel.normal[axis]) * side, 0.0, 1.0);
}

double VoxelEmitters::weight(const Voxel& voxel, int axis, int side) const {
  if (voxel.emission == 0 || voxel.emission >= entries_.size()) return 0;
  return share(voxel, axis, side) * luminance(entries_[voxel.emission].radiance);
}

glm::vec3 VoxelEmitters::radiance(const Voxel& voxel, const glm::vec3& direction) const {
  if (voxel.emission == 0 || voxel.emission >= entries_.size()) return glm::vec3(0);
  const scene::EmissionEntry& entry = entries_[voxel.emission];
  if (!entry.two_sided && glm::dot(voxel.normal, direction) >= 0) return glm::vec3(0);
  return entry.radiance * scales_[voxel.emission];
}

VoxelEmitters::Sample VoxelEmitters::sample(const glm::vec2& pick, const glm::vec2& point) const {
  const double total = cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, static_cast<double>(pick.x) * total);
  const auto index = static_cast<size_t>(found - cumulative_.begin());
  const Face& face = faces_[index];
  Sample sample;
  sample.voxel = face.voxel;
  sample.normal[face.axis] = face.side;
  sample.point = glm::dvec3(face.voxel);
  sample.point[face.axis] += face.side > 0 ? 1 : 0;
  sample.point[(face.axis + 1) % 3] += static_cast<double>(point.x);
  sample.point[(face.axis + 2) % 3] += static_cast<double>(point.y);
  sample.density = density(grid_.decode(face.voxel), face.axis, face.side);
  return sample;
}

double VoxelEmitters::density(const Voxel& voxel, int axis, int side) const {
  return cumulative_.empty() ? 0 : weight(voxel, axis, side) / cumulative_.back();
}

}  // namespace lightloom::reference
