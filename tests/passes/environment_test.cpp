#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/shaders/statistics.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;

PassType make_test_environment() {
  PassType type;
  type.name = "test_environment";
  type.doc = "Samples the environment.";
  for (const char* name : {"sampled", "looked_up", "even", "place"}) {
    Port port = passes::image_output_like(name, Format::rgba32_sfloat, "", "for the host");
    port.extent = ExtentRule::view;
    type.ports.push_back(port);
  }
  type.reads = FrameState::lights | FrameState::seed;
  type.record = [](PassContext& context) {
    context.dispatch({"test_environment.comp", context.output_extent("sampled"), {}});
  };
  return type;
}

struct Texels {
  uint32_t width, height;
  std::function<double(uint32_t, uint32_t)> radiance;
};

scene::Scene scene_under(const Texels& texels) {
  scene::Scene scene = make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 3, 0}, {0, 0, 0}, 1));
  scene.environment.radiance = glm::vec3(1);
  scene.environment.width = texels.width;
  scene.environment.height = texels.height;
  for (uint32_t y = 0; y < texels.height; ++y)
    for (uint32_t x = 0; x < texels.width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        scene.environment.rgb.push_back(static_cast<float>(texels.radiance(x, y)));
  scene.features.environment = scene.features.environment_image = true;
  return scene;
}

/// Spots of light on a dark ground that differs from row to row and column to column.
Texels spots() {
  return {64, 32, [](uint32_t x, uint32_t y) {
            if (x == 63 && y == 0) return 60.0;
            if (x > 40 && x < 44 && y == 20) return 200.0;
            return 0.2 + (x * 5 + y * 3) % 7;
          }};
}

std::vector<Images> sample(const scene::Scene& scene, uint32_t frames = 1) {
  GraphRunOptions options;
  options.extra_types = {make_test_environment()};
  options.frames = frames;
  options.seed = 3;
  return run_graph(graph_text(512, 512, 64, 64, R"("e": { "type": "test_environment" })",
                              R"("sampled": "e.sampled", "looked_up": "e.looked_up", "even": "e.even",
                                 "place": "e.place")"),
                   scene, options);
}

template <class Visit>
void for_each_pixel(const Images& images, const Visit& visit) {
  const Extent3 extent = images.at("sampled").desc.extent;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) visit(x, y);
}

glm::dvec3 direction_at(const image::HostImage& image, uint32_t x, uint32_t y) {
  return {image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2)};
}

/// Bilinear filtering, u repeating and v clamped.
double filtered(const Texels& texels, double u, double v) {
  const double x = u * texels.width - 0.5, y = v * texels.height - 0.5;
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  const auto at = [&](int i, int j) {
    const int w = static_cast<int>(texels.width), h = static_cast<int>(texels.height);
    return texels.radiance(static_cast<uint32_t>((i + w) % w), static_cast<uint32_t>(std::clamp(j, 0, h - 1)));
  };
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  return (1 - fy) * ((1 - fx) * at(i, j) + fx * at(i + 1, j)) + fy * ((1 - fx) * at(i, j + 1) + fx * at(i + 1, j + 1));
}

/// Light from every cell of the image's own grid: many filtered lookups times the cell's solid angle, or equal solid
/// angles, which is wrong. Each cell in four parts of equal solid angle, as observed counts are binned.
std::vector<double> expected_parts(const Texels& texels, double samples, bool solid_angles) {
  constexpr int kPoints = 16;
  std::vector<double> cells;
  double total = 0;
  for (uint32_t y = 0; y < texels.height; ++y)
    for (uint32_t x = 0; x < texels.width; ++x) {
      double sum = 0;
      for (int j = 0; j < kPoints; ++j)
        for (int i = 0; i < kPoints; ++i)
          sum += filtered(texels, (x + (i + 0.5) / kPoints) / texels.width, (y + (j + 0.5) / kPoints) / texels.height);
      const double top = kPi * y / texels.height, bottom = kPi * (y + 1) / texels.height;
      cells.push_back(sum * (solid_angles ? std::cos(top) - std::cos(bottom) : 1));
      total += cells.back();
    }
  std::vector<double> parts;
  for (const double cell : cells) parts.insert(parts.end(), 4, cell / total * samples / 4);
  return parts;
}

size_t part_of(const Texels& texels, const glm::dvec3& d) {
  const double column = (std::atan2(d.z, d.x) / (2 * kPi) + 0.5) * texels.width;
  const double row = std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi * texels.height;
  const auto c = std::min(static_cast<uint32_t>(column), texels.width - 1);
  const auto r = std::min(static_cast<uint32_t>(row), texels.height - 1);
  const double top = std::cos(kPi * r / texels.height), bottom = std::cos(kPi * (r + 1) / texels.height);
  const size_t half = (column - c >= 0.5 ? 1 : 0) + (d.y < 0.5 * (top + bottom) ? 2 : 0);
  return (size_t{r} * texels.width + c) * 4 + half;
}

class EnvironmentSampling : public DeviceTest {};

TEST_F(EnvironmentSampling, FollowsTheLightOfTheImage) {
  const Texels texels = spots();
  std::vector<double> observed(size_t{texels.width} * texels.height * 4);
  double count = 0;
  for (const Images& images : sample(scene_under(texels), 4))
    for_each_pixel(images, [&](uint32_t x, uint32_t y) {
      ASSERT_EQ(images.at("looked_up").at(x, y, 0, 2), 1);
      ++observed[part_of(texels, direction_at(images.at("sampled"), x, y))];
      ++count;
    });
  EXPECT_GT(chi_square(observed, expected_parts(texels, count, true)).p_value, 1e-3);
  EXPECT_LT(chi_square(observed, expected_parts(texels, count, false)).p_value, 1e-9) << "solid angles left out";
  std::vector<double> shifted = expected_parts(texels, count, true);
  std::rotate(shifted.begin(), shifted.begin() + 4, shifted.end());
  EXPECT_LT(chi_square(observed, shifted).p_value, 1e-9) << "one cell aside";
}

TEST_F(EnvironmentSampling, DensityOfASampleIsTheDensityLookedUp) {
  for (const Texels& texels :
       {spots(), Texels{7, 3, [](uint32_t x, uint32_t y) { return x == 2 && y == 0 ? 1 : 0; }}}) {
    const Images images = sample(scene_under(texels)).front();
    double light = 0, squares = 0, count = 0;
    for_each_pixel(images, [&](uint32_t x, uint32_t y) {
      const image::HostImage &sampled = images.at("sampled"), &looked_up = images.at("looked_up");
      ASSERT_GT(sampled.at(x, y, 0, 3), 0);
      ASSERT_EQ(sampled.at(x, y, 0, 3), looked_up.at(x, y, 0, 0)) << x << " " << y;
      ASSERT_NEAR(glm::length(direction_at(sampled, x, y)), 1, 1e-6);
      const double weighted = looked_up.at(x, y, 0, 1) / sampled.at(x, y, 0, 3);
      light += weighted;
      squares += weighted * weighted;
      ++count;
    });
    // Light over density, on average, is the integral of the light over the sphere.
    double exact = 0;
    constexpr int kRows = 600, kColumns = 700;
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i)
        exact += filtered(texels, (i + 0.5) / kColumns, (j + 0.5) / kRows) *
                 (std::cos(kPi * j / kRows) - std::cos(kPi * (j + 1) / kRows)) * 2 * kPi / kColumns;
    const double mean = light / count, error = std::sqrt((squares / count - mean * mean) / count);
    // Devices filter with positions rounded to 1/256 of a texel.
    EXPECT_NEAR(mean, exact, 3 * error + 1e-3 * exact) << texels.width;
  }
}

TEST_F(EnvironmentSampling, DensityIntegratesToOneWithPolesAndSeam) {
  const Texels texels = spots();
  const Images images = sample(scene_under(texels)).front();
  const image::HostImage &even = images.at("even"), &place = images.at("place");
  double sum = 0, weights = 0;
  for_each_pixel(images, [&](uint32_t x, uint32_t y) {
    const glm::dvec3 d = direction_at(even, x, y);
    ASSERT_GT(even.at(x, y, 0, 3), 0) << x << " " << y;
    const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi;
    // A unit vector in single precision is this far from its polar angle near the poles.
    ASSERT_NEAR(place.at(x, y, 0, 1), v, std::abs(d.y) > 0.9999 ? 1e-3 : 3e-5) << d.y;
    const double u = std::atan2(d.z, d.x) / (2 * kPi) + 0.5;
    const double apart = std::abs(place.at(x, y, 0, 0) - u);
    if (d.x != 0 || d.z != 0) {
      ASSERT_LT(std::min(apart, 1 - apart), 3e-5) << d.x << " " << d.z;
    }
    const double weight = (x == 0 || x == 511 ? 0.5 : 1) * (y == 0 || y == 511 ? 0.5 : 1);
    sum += weight * even.at(x, y, 0, 3);
    weights += weight;
  });
  EXPECT_NEAR(sum / weights * 4 * kPi, 1, 0.01);
}

TEST_F(EnvironmentSampling, ConstantIsUniformOverTheSphere) {
  scene::Scene scene = scene_under(spots());
  scene.environment = {};
  scene.environment.radiance = glm::vec3(2);
  for (const bool general : {false, true}) {
    scene.features.environment_image = general;
    const Images images = sample(scene).front();
    std::vector<double> observed(16 * 16), expected(16 * 16, 512 * 512 / 256.0);
    for_each_pixel(images, [&](uint32_t x, uint32_t y) {
      const glm::dvec3 d = direction_at(images.at("sampled"), x, y);
      ASSERT_NEAR(images.at("sampled").at(x, y, 0, 3), 1 / (4 * kPi), 1e-7);
      ASSERT_EQ(images.at("sampled").at(x, y, 0, 3), images.at("even").at(x, y, 0, 3));
      const auto row = static_cast<size_t>(std::clamp((1 - d.y) * 8, 0.0, 15.0));
      const auto column = static_cast<size_t>(std::clamp((std::atan2(d.z, d.x) / kPi + 1) * 8, 0.0, 15.0));
      ++observed[row * 16 + column];
    });
    EXPECT_GT(chi_square(observed, expected).p_value, 1e-3);
  }
}

TEST_F(EnvironmentSampling, BlackGivesNoSample) {
  const Images images = sample(scene_under({8, 4, [](auto, auto) { return 0.0; }})).front();
  for_each_pixel(images, [&](uint32_t x, uint32_t y) {
    ASSERT_EQ(images.at("looked_up").at(x, y, 0, 2), 0);
    ASSERT_EQ(images.at("sampled").at(x, y, 0, 3), 0);
    ASSERT_EQ(images.at("even").at(x, y, 0, 3), 0);
  });
}

}  // namespace
}  // namespace lightloom::test
