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

double fraction(uint32_t channel, uint32_t bits) {
  return channel / (std::exp2(bits) - 1);
}

float squared(uint32_t channel, uint32_t bits) {
  const double root = fraction(channel, bits);
  return static_cast<float>(root * root);
}

struct Image {
  std::span<const uint8_t> bytes;
  uint32_t bits = 8;
};

/// A frame around a normal, and how a tangent lies in it.
struct Directions {
  glm::dvec3 normal, tangent;
};

// The encoding is that of the paper, section 2.1, with the details of passes/bundles.hpp: y is the pole, azimuths are
// 256ths of a turn from z towards x, polar angles 254ths of half a turn; with 16 bits 65536ths and 65534ths. The
// tangent lies in the frame of the normal, x along growing azimuth: with 8 bits its x from -1 to 1 in six bits, then
// whether its y is negative; with 16 its angle in 32768ths of a turn.
Directions decode_directions(const VoxelGrid::Texel& texel, uint32_t bits) {
  const double steps = std::exp2(bits);
  const double azimuth = texel[0] * (2 * kPi / steps),
               polar = std::min<double>(texel[1], steps - 2) * (kPi / (steps - 2));
  const glm::dvec3 x(std::cos(azimuth), 0, -std::sin(azimuth));
  const glm::dvec3 n(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
  const glm::dvec3 y = glm::cross(n, x);
  if (bits == 16) {
    const double angle = (texel[2] & 32767) * (2 * kPi / 32768);
    return {n, std::cos(angle) * x + std::sin(angle) * y};
  }
  const double along = (texel[2] & 63) * (2.0 / 63) - 1;
  const double across = std::sqrt(std::max(1 - along * along, 0.0)) * ((texel[2] & 64) != 0 ? -1 : 1);
  return {n, along * x + across * y};
}

}  // namespace

VoxelGrid::VoxelGrid(const VoxelImages& images, const scene::Bounds& bounds) : images_(images) {
  const size_t count = index({0, 0, images.extent.z});
  for (const Image& image : {Image{images.albedo, images.albedo_bits}, Image{images.normal, images.normal_bits},
                             Image{images.material, images.material_bits}}) {
    if (image.bits != 8 && image.bits != 16)
      throw Error(ExitCode::invalid_input, "a voxel image has " + std::to_string(image.bits) + " bits a channel");
    if (image.bytes.size() != count * 4 * (image.bits / 8))
      throw Error(ExitCode::invalid_input, "a voxel image has " + std::to_string(image.bytes.size()) +
                                               " bytes, not the " + std::to_string(count * 4 * (image.bits / 8)) +
                                               " of its extent");
  }
  const glm::dvec3 low(bounds.min), high(glm::max(bounds.max, bounds.min));
  const double magnitude = largest(glm::max(glm::abs(low), glm::abs(high)));
  const double longest = std::max({largest(high - low), magnitude * 1e-6, 1e-20});
  voxel_size_ = longest / std::max(largest(glm::dvec3(images.extent)) - 2, 1.0);
  origin_ = 0.5 * (low + high) - 0.5 * voxel_size_ * glm::dvec3(images.extent);
  for (size_t i = 0; i < count; ++i)
    occupied_.push_back(fraction(texel(images.albedo, images.albedo_bits, i)[3], images.albedo_bits) > 0.5 ? 1 : 0);
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

VoxelGrid::Texel VoxelGrid::texel(std::span<const uint8_t> image, uint32_t bits, size_t index) {
  Texel texel{};
  for (size_t i = 0; i < texel.size(); ++i) {
    const size_t channel = index * texel.size() + i;
    texel[i] = bits == 8 ? image[channel] : image[2 * channel] + 256u * image[2 * channel + 1];
  }
  return texel;
}

Voxel VoxelGrid::decode(const glm::ivec3& voxel) const {
  const size_t at = index(voxel);
  const Texel albedo = texel(images_.albedo, images_.albedo_bits, at),
              normal = texel(images_.normal, images_.normal_bits, at),
              material = texel(images_.material, images_.material_bits, at);
  const Directions directions = decode_directions(normal, images_.normal_bits);
  const auto root = [&](uint32_t channel) { return squared(channel, images_.material_bits); };
  const uint32_t bits = images_.albedo_bits;
  constexpr float kLeastAlpha = 1e-3f;
  Voxel result;
  result.normal = glm::vec3(directions.normal);
  result.tangent = glm::vec3(directions.tangent);
  result.reflectance.base_color = {squared(albedo[0], bits), squared(albedo[1], bits), squared(albedo[2], bits)};
  result.reflectance.metallic = static_cast<float>(fraction(normal[3], images_.normal_bits));
  result.reflectance.alpha = glm::max(glm::vec2(root(material[0]), root(material[1])), glm::vec2(kLeastAlpha));
  result.reflectance.f0 = static_cast<float>(fraction(material[2], images_.material_bits) / 4);
  result.reflectance.f90 = std::min(result.reflectance.f0 / 0.04f, 1.0f);
  result.emission = static_cast<uint32_t>(std::lround(fraction(material[3], images_.material_bits) * 255));
  return result;
}

}  // namespace lightloom::reference
