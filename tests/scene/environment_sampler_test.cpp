#include "framework/scene/environment_sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lightloom::scene {
namespace {

constexpr double kPi = 3.141592653589793;

Environment make_environment(uint32_t width, uint32_t height,
                             const std::function<float(uint32_t, uint32_t)>& radiance) {
  Environment environment;
  environment.radiance = glm::vec3(1);
  environment.width = width;
  environment.height = height;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel) environment.rgb.push_back(radiance(x, y));
  return environment;
}

double cumulative_row(const EnvironmentTable& table, uint32_t row) {
  return static_cast<double>(table.texels[size_t{row} * (table.columns + 1) + table.columns].x);
}

/// Probability that the table gives to a cell by its cumulative sums.
double probability(const EnvironmentTable& table, uint32_t column, uint32_t row) {
  const size_t texel = size_t{row} * (table.columns + 1) + column;
  const double in_row =
      static_cast<double>(table.texels[texel].x) - (column == 0 ? 0 : static_cast<double>(table.texels[texel - 1].x));
  return in_row * (cumulative_row(table, row) - (row == 0 ? 0 : cumulative_row(table, row - 1)));
}

double density(const EnvironmentTable& table, uint32_t column, uint32_t row) {
  return static_cast<double>(table.texels[size_t{row} * (table.columns + 1) + column].y);
}

/// Checks what holds for every table: sums that never fall and end at 1, whole steps of 2^-24, densities that are the
/// probabilities over the cells' solid angles.
void expect_a_distribution(const EnvironmentTable& table) {
  ASSERT_EQ(table.texels.size(), size_t{table.columns + 1} * table.rows);
  double total = 0;
  for (uint32_t r = 0; r < table.rows; ++r) {
    const double solid_angle = (std::cos(kPi * r / table.rows) - std::cos(kPi * (r + 1) / table.rows)) * 2 * kPi;
    for (uint32_t c = 0; c < table.columns; ++c) {
      const double p = probability(table, c, r);
      ASSERT_GE(p, 0) << c << " " << r;
      const double steps = static_cast<double>(table.texels[size_t{r} * (table.columns + 1) + c].x) * 0x1p24;
      ASSERT_EQ(steps, std::round(steps));
      // The row's edges are cosines in single precision, which near a pole is felt in the third digit.
      ASSERT_NEAR(density(table, c, r), p / (solid_angle / table.columns), 2e-3 * density(table, c, r))
          << c << " " << r;
      total += p;
    }
  }
  EXPECT_EQ(cumulative_row(table, table.rows - 1), 1);
  EXPECT_NEAR(total, 1, 1e-12);
}

TEST(EnvironmentSampler, ConstantIsUniformOverTheSphere) {
  Environment environment;
  environment.radiance = glm::vec3(0.2f, 3, 0.1f);
  const EnvironmentTable table = build_environment_table(environment);
  EXPECT_EQ(table.columns, 1u);
  EXPECT_EQ(table.rows, 1u);
  EXPECT_EQ(table.texels[0].x, 1);
  EXPECT_NEAR(density(table, 0, 0), 1 / (4 * kPi), 1e-8);
  EXPECT_EQ(table.texels[1], glm::vec2(1, -1));
  // An image of one colour is so too, whatever its size.
  const EnvironmentTable flat = build_environment_table(make_environment(37, 19, [](auto, auto) { return 2.5f; }));
  expect_a_distribution(flat);
  for (uint32_t r = 0; r < flat.rows; ++r)
    for (uint32_t c = 0; c < flat.columns; ++c) ASSERT_NEAR(density(flat, c, r) * 4 * kPi, 1, 1e-3) << c << " " << r;
}

TEST(EnvironmentSampler, DensityFollowsTheFilteredLuminance) {
  const auto value = [](uint32_t x, uint32_t y) { return 0.1f + static_cast<float>((x * 7 + y * 13) % 11); };
  const EnvironmentTable table = build_environment_table(make_environment(24, 12, value));
  expect_a_distribution(table);
  // Over the cell of one texel the filter weighs texels 1/8, 3/4, 1/8 along each axis.
  const auto filtered = [&](uint32_t x, uint32_t y) {
    const double weights[3] = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        sum += weights[i + 1] * weights[j + 1] *
               static_cast<double>(value((x + 24 + static_cast<uint32_t>(i)) % 24,
                                         static_cast<uint32_t>(std::clamp(static_cast<int>(y) + j, 0, 11))));
    return sum;
  };
  const double scale = density(table, 5, 5) / filtered(5, 5);
  for (uint32_t y = 0; y < 12; ++y)
    for (uint32_t x = 0; x < 24; ++x) ASSERT_NEAR(density(table, x, y), scale * filtered(x, y), 2e-4 * scale * 10);
}

TEST(EnvironmentSampler, BlackRowsAreNeverPicked) {
  const EnvironmentTable table = build_environment_table(
      make_environment(16, 16, [](auto, uint32_t y) { return y >= 4 && y < 12 ? 1.0f : 0.0f; }));
  expect_a_distribution(table);
  for (uint32_t r = 0; r < 16; ++r)
    for (uint32_t c = 0; c < 16; ++c)
      // The filter carries light half a texel beyond the rows that have it.
      ASSERT_EQ(density(table, c, r) > 0, r >= 3 && r < 13) << c << " " << r;
}

TEST(EnvironmentSampler, OneBrightTexelReachesAsFarAsTheFilterAndAcrossTheSeam) {
  const EnvironmentTable table = build_environment_table(
      make_environment(32, 16, [](uint32_t x, uint32_t y) { return x == 0 && y == 9 ? 1e6f : 0.0f; }));
  expect_a_distribution(table);
  for (uint32_t r = 0; r < 16; ++r)
    for (uint32_t c = 0; c < 32; ++c)
      ASSERT_EQ(density(table, c, r) > 0, r >= 8 && r <= 10 && (c <= 1 || c == 31)) << c << " " << r;
  EXPECT_NEAR(probability(table, 0, 9), 0.75 * 0.75, 0.01);
}

TEST(EnvironmentSampler, NothingThatShinesIsLostBesideSomethingVeryBright) {
  const EnvironmentTable table = build_environment_table(
      make_environment(64, 32, [](uint32_t x, uint32_t y) { return x == 20 && y == 9 ? 1e9f : 1e-9f; }));
  expect_a_distribution(table);
  for (uint32_t r = 0; r < 32; ++r)
    for (uint32_t c = 0; c < 64; ++c) ASSERT_GT(density(table, c, r), 0) << c << " " << r;
}

TEST(EnvironmentSampler, AllBlackHasNoDensity) {
  for (const EnvironmentTable& table :
       {build_environment_table(make_environment(8, 4, [](auto, auto) { return 0.0f; })),
        build_environment_table(Environment{})})
    for (uint32_t r = 0; r < table.rows; ++r) {
      EXPECT_EQ(cumulative_row(table, r), 0);
      for (uint32_t c = 0; c < table.columns; ++c) ASSERT_EQ(density(table, c, r), 0);
    }
}

TEST(EnvironmentSampler, LargeImagesAreAveragedToTheLargestGrid) {
  const EnvironmentTable table = build_environment_table(
      make_environment(1300, 700, [](uint32_t x, uint32_t y) { return x == 700 && y == 300 ? 1.0f : 0.0f; }));
  EXPECT_EQ(table.columns, kEnvironmentColumns);
  EXPECT_EQ(table.rows, kEnvironmentRows);
  expect_a_distribution(table);
  for (uint32_t r = 0; r < table.rows; ++r)
    for (uint32_t c = 0; c < table.columns; ++c) {
      // The cell overlaps the texels from 699.5 to 701.5, which the bright one reaches.
      const bool column = (c + 1) * 1300.0 / 512 > 699.5 && c * 1300.0 / 512 < 701.5;
      const bool row = (r + 1) * 700.0 / 256 > 299.5 && r * 700.0 / 256 < 301.5;
      ASSERT_EQ(density(table, c, r) > 0, column && row) << c << " " << r;
    }
}

TEST(EnvironmentSampler, ExtremeRadianceStaysFinite) {
  Environment environment = make_environment(8, 4, [](uint32_t x, auto) { return x == 3 ? 3e38f : 1.0f; });
  environment.radiance = glm::vec3(1e9f);
  expect_a_distribution(build_environment_table(environment));
}

}  // namespace
}  // namespace lightloom::scene
