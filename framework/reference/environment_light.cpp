#include "framework/reference/environment_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/scene/environment_sampler.hpp"

namespace lightloom::reference {
namespace {

constexpr double kPi = std::numbers::pi;

/// Row from the pole +y, column from longitude -pi, in texels.
glm::dvec2 place_of(const glm::vec3& direction, uint32_t width, uint32_t height) {
  const glm::dvec3 d(direction);
  const double longitude = std::atan2(d.z, d.x);
  const double polar = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
  return {(longitude / (2 * kPi) + 0.5) * width, polar / kPi * height};
}

uint32_t cell(double place, uint32_t count) {
  return static_cast<uint32_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

EnvironmentLight::EnvironmentLight(const scene::Environment& environment) : environment_(&environment) {
  const bool black_image =
      is_image() && std::all_of(environment.rgb.begin(), environment.rgb.end(), [](float value) { return value == 0; });
  shines_ = environment.radiance != glm::vec3(0) && !black_image;
  if (shines_ && is_image()) build_table();
}

glm::vec3 EnvironmentLight::texel(size_t index) const {
  const scene::Environment& from = *environment_;
  return {scene::environment_texel(from, index * 3), scene::environment_texel(from, index * 3 + 1),
          scene::environment_texel(from, index * 3 + 2)};
}

void EnvironmentLight::build_table() {
  const uint32_t width = environment_->width, height = environment_->height;
  const auto luminance = [&](int64_t x, int64_t y) {
    const auto column = static_cast<size_t>((x + width) % width);
    const auto row = static_cast<size_t>(std::clamp<int64_t>(y, 0, height - 1));
    const glm::dvec3 color = glm::dvec3(texel(row * width + column)) * glm::dvec3(environment_->radiance);
    return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
  };
  // The mean of the filtered image over a texel's place takes an eighth of each neighbour along either axis.
  const auto mean = [&](int64_t x, int64_t y) {
    const auto row = [&](int64_t v) {
      return 0.125 * (luminance(x - 1, v) + luminance(x + 1, v)) + 0.75 * luminance(x, v);
    };
    return 0.125 * (row(y - 1) + row(y + 1)) + 0.75 * row(y);
  };
  std::vector<double> weights(size_t{width} * height);
  std::vector<double> solid_angles(height);
  double total = 0;
  for (uint32_t y = 0; y < height; ++y) {
    solid_angles[y] = (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height)) * 2 * kPi / width;
    for (uint32_t x = 0; x < width; ++x) total += weights[size_t{y} * width + x] = mean(x, y) * solid_angles[y];
  }
  double above = 0;
  for (uint32_t y = 0; y < height; ++y) {
    double in_row = 0;
    for (uint32_t x = 0; x < width; ++x) in_row += weights[size_t{y} * width + x];
    double before = 0;
    for (uint32_t x = 0; x < width; ++x) {
      const double weight = weights[size_t{y} * width + x];
      before += weight;
      columns_.push_back(in_row > 0 ? static_cast<float>(before / in_row) : 0);
      pdfs_.push_back(static_cast<float>(weight / total / solid_angles[y]));
    }
    above += in_row;
    rows_.push_back(above / total);
  }
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
  if (!shines_) return glm::vec3(0);
  if (!is_image()) return environment_->radiance;
  const int64_t width = environment_->width, height = environment_->height;
  const glm::dvec2 place = place_of(direction, environment_->width, environment_->height) - 0.5;
  const auto x = static_cast<int64_t>(std::floor(place.x)), y = static_cast<int64_t>(std::floor(place.y));
  const auto at = [&](int64_t column, int64_t row) {
    return texel(static_cast<size_t>(std::clamp<int64_t>(row, 0, height - 1) * width + (column + width) % width));
  };
  const auto across = static_cast<float>(place.x - static_cast<double>(x));
  const auto down = static_cast<float>(place.y - static_cast<double>(y));
  const glm::vec3 upper = glm::mix(at(x, y), at(x + 1, y), across);
  const glm::vec3 lower = glm::mix(at(x, y + 1), at(x + 1, y + 1), across);
  return glm::mix(upper, lower, down) * environment_->radiance;
}

float EnvironmentLight::pdf(const glm::vec3& direction) const {
  if (!shines_) return 0;
  if (!is_image()) return static_cast<float>(1 / (4 * kPi));
  const uint32_t width = environment_->width, height = environment_->height;
  const glm::dvec2 place = place_of(direction, width, height);
  return pdfs_[size_t{cell(place.y, height)} * width + cell(place.x, width)];
}

LightSample EnvironmentLight::sample(const glm::vec2& pick, const glm::vec2& point) const {
  LightSample result;
  if (!shines_) return result;
  double top = 1, bottom = -1, left = 0, width = 1;
  if (is_image()) {
    const uint32_t columns = environment_->width, rows = environment_->height;
    const auto row = static_cast<uint32_t>(std::min<std::ptrdiff_t>(
        std::upper_bound(rows_.begin(), rows_.end(), static_cast<double>(pick.x)) - rows_.begin(), rows - 1));
    const auto begin = columns_.begin() + static_cast<std::ptrdiff_t>(size_t{row} * columns);
    const auto column = std::min<std::ptrdiff_t>(std::upper_bound(begin, begin + columns, pick.y) - begin, columns - 1);
    top = std::cos(kPi * row / rows);
    bottom = std::cos(kPi * (row + 1) / rows);
    left = static_cast<double>(column) / columns;
    width = 1.0 / columns;
  }
  const double y = top + (bottom - top) * static_cast<double>(point.x);
  const double longitude = 2 * kPi * (left + width * static_cast<double>(point.y)) - kPi;
  const double across = std::sqrt(std::max(0.0, 1 - y * y));
  result.direction = glm::vec3(across * std::cos(longitude), y, across * std::sin(longitude));
  // Rounding may have taken the direction over the rim of a texel: the density is that of where it is.
  const LightHit there = hit(result.direction);
  result.radiance = there.radiance;
  result.pdf = there.pdf;
  return result;
}

}  // namespace lightloom::reference
