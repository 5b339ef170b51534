#include "framework/reference/voxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace lightloom::reference {
namespace {

constexpr double kPi = std::numbers::pi;

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

float squared(uint8_t byte) {
  const double root = byte / 255.0;
  return static_cast<float>(root * root);
}

}  // namespace

VoxelGrid::VoxelGrid(const VoxelImages& images, const scene::Bounds& bounds) : images_(images) {
  const size_t count = index({0, 0, images.extent.z});
  for (const std::span<const uint8_t>& bytes : {images.albedo, images.normal, images.material})
    if (bytes.size() != count * 4)
      throw Error(ExitCode::invalid_input, "a voxel image has " + std::to_string(bytes.size()) + " bytes, not the " +
                                               std::to_string(count * 4) + " of its extent");
  const glm::dvec3 low(bounds.min), high(glm::max(bounds.max, bounds.min));
  const double magnitude = largest(glm::max(glm::abs(low), glm::abs(high)));
  const double longest = std::max({largest(high - low), magnitude * 1e-6, 1e-20});
  voxel_size_ = longest / std::max(largest(glm::dvec3(images.extent)) - 2, 1.0);
  origin_ = 0.5 * (low + high) - 0.5 * voxel_size_ * glm::dvec3(images.extent);
  for (size_t i = 0; i < count; ++i) occupied_.push_back(images.albedo[i * 4 + 3] >= 128 ? 1 : 0);
}

std::optional<VoxelGrid::Hit> VoxelGrid::first_hit(const glm::dvec3& origin, const glm::dvec3& direction,
                                                   double end) const {
  const glm::dvec3 size(images_.extent);
  Hit hit;
  double leave = end;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < 0 || origin[axis] >= size[axis]) return std::nullopt;
      continue;
    }
    const bool forward = direction[axis] > 0;
    const double near = ((forward ? 0 : size[axis]) - origin[axis]) / direction[axis];
    if (near > hit.t) hit = {{}, near, axis, forward ? -1 : 1};
    leave = std::min(leave, ((forward ? size[axis] : 0) - origin[axis]) / direction[axis]);
  }
  if (!(hit.t <= leave)) return std::nullopt;
  const glm::dvec3 entry = origin + direction * hit.t;
  hit.voxel = glm::clamp(glm::ivec3(glm::floor(entry)), glm::ivec3(0), images_.extent - 1);
  if (hit.axis >= 0) hit.voxel[hit.axis] = hit.side < 0 ? 0 : images_.extent[hit.axis] - 1;
  while (occupied_[index(hit.voxel)] == 0) {
    double exit = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) continue;
      // From the whole number of the plane, so that errors do not add up along the ray.
      const double plane = hit.voxel[axis] + (direction[axis] > 0 ? 1 : 0);
      const double t = (plane - origin[axis]) / direction[axis];
      if (t >= exit) continue;
      exit = t;
      hit.axis = axis;
    }
    hit.side = direction[hit.axis] > 0 ? -1 : 1;
    hit.t = std::max(hit.t, exit);
    hit.voxel[hit.axis] -= hit.side;
    if (hit.t > end || hit.voxel[hit.axis] < 0 || hit.voxel[hit.axis] >= images_.extent[hit.axis]) return std::nullopt;
  }
  return hit;
}

// The encoding is that of the paper, section 2.1, with the details of passes/bundles.hpp: y is the pole, azimuths are
// 256ths of a turn from z towards x, polar angles 254ths of half a turn. The tangent lies in the frame of the normal,
// x along growing azimuth: its x from -1 to 1 in six bits, then whether its y is negative.
Voxel VoxelGrid::decode(const glm::ivec3& voxel) const {
  const size_t at = index(voxel) * 4;
  const std::span<const uint8_t> albedo = images_.albedo.subspan(at, 4), normal = images_.normal.subspan(at, 4),
                                 material = images_.material.subspan(at, 4);
  const double azimuth = normal[0] * (2 * kPi / 256), polar = std::min<int>(normal[1], 254) * (kPi / 254);
  const glm::dvec3 x(std::cos(azimuth), 0, -std::sin(azimuth));
  const glm::dvec3 n(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
  const glm::dvec3 y = glm::cross(n, x);
  const double along = (normal[2] & 63) * (2.0 / 63) - 1;
  const double across = std::sqrt(std::max(1 - along * along, 0.0)) * ((normal[2] & 64) != 0 ? -1 : 1);
  constexpr float kLeastAlpha = 1e-3f;
  Voxel result;
  result.normal = glm::vec3(n);
  result.tangent = glm::vec3(along * x + across * y);
  result.reflectance.base_color = {squared(albedo[0]), squared(albedo[1]), squared(albedo[2])};
  result.reflectance.metallic = static_cast<float>(normal[3] / 255.0);
  result.reflectance.alpha = glm::max(glm::vec2(squared(material[0]), squared(material[1])), glm::vec2(kLeastAlpha));
  result.reflectance.f0 = static_cast<float>(material[2] / (4 * 255.0));
  result.reflectance.f90 = std::min(result.reflectance.f0 / 0.04f, 1.0f);
  result.emission = material[3];
  return result;
}

}  // namespace lightloom::reference
