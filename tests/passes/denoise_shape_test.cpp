#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/passes/filter_support.hpp"
#include "tests/support/device_fixture.hpp"

// What the filters make of a single lit pixel, against geometry in doubles.
namespace lightloom::test {
namespace {

class DenoiseShape : public DeviceTest {};

scene::Scene wall(const scene::Material& material, float distance = 3) {
  return make_quad_scene({{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}}, {material},
                         look_at({0, 0, distance}, {0, 0, 0}, 0.8f));
}

/// Metal with the Ward alphas 1 along the tangent and roughness^2 across it.
scene::Material brushed(float roughness) {
  scene::Material material;
  material.metallic = 1;
  material.roughness = roughness;
  material.anisotropy_strength = 1;
  return material;
}

/// Pixels to the right of the middle that got something, in its row; below it, in its column.
int reach_x(const image::HostImage& image) {
  int count = 0;
  for (uint32_t x = image.desc.extent.width / 2 + 1; x < image.desc.extent.width; ++x)
    count += image.at(x, image.desc.extent.height / 2, 0, 0) > 0 ? 1 : 0;
  return count;
}
int reach_y(const image::HostImage& image) {
  int count = 0;
  for (uint32_t y = image.desc.extent.height / 2 + 1; y < image.desc.extent.height; ++y)
    count += image.at(image.desc.extent.width / 2, y, 0, 0) > 0 ? 1 : 0;
  return count;
}

/// Width of a pixel on a wall that is seen head on [m].
double pixel_size(double distance, uint32_t size) {
  return 2 * distance * std::tan(0.4) / size;
}

std::vector<FilterStage> both_radial(const std::string& params) {
  return {{"denoise_radial", R"("axis": "tangent", "taps": 64, )" + params},
          {"denoise_radial", R"("axis": "bitangent", "taps": 64, )" + params}};
}

// --- A slanted plane in perspective ---------------------------------------------------------------------------------

constexpr double kAlong = 0.30, kAcross = 0.49 * kAlong;  // half lengths [m]: roughness 0.7, squared

/// A brushed floor seen at a slant; its tangent is x, its bitangent z.
struct SlantedFloor {
  uint32_t size = 161;
  glm::dvec3 eye{0, 1.6, 1.8}, target{0, 0, 0};
  PinholeOracle camera{eye, target, 0.8, 161};
  scene::Scene scene = make_quad_scene({{{-4, 0, 4}, {8, 0, 0}, {0, 0, -8}}}, {brushed(0.7f)},
                                       look_at(glm::vec3(eye), glm::vec3(target), 0.8f));
  Images images =
      run_filters(scene, {.size = 161, .stages = both_radial(R"("lobe": "specular", )" + fixed_reach(scene, kAlong))});
  [[nodiscard]] double response(uint32_t x, uint32_t y) const { return images.at("radiance").at(x, y, 0, 0); }
};

/// The rectangle around the middle on the screen, corners in turn.
std::array<glm::dvec2, 4> trapezoid(const SlantedFloor& floor) {
  return {floor.camera.project({-kAlong, 0, kAcross}), floor.camera.project({kAlong, 0, kAcross}),
          floor.camera.project({kAlong, 0, -kAcross}), floor.camera.project({-kAlong, 0, -kAcross})};
}

/// Distance from the nearest edge [pixels], positive inside.
double depth_inside(const std::array<glm::dvec2, 4>& corners, const glm::dvec2& p) {
  double least = 1e9;
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec2 a = corners[i], edge = corners[(i + 1) % 4] - a;
    least = std::min(least, (edge.y * (p.x - a.x) - edge.x * (p.y - a.y)) / glm::length(edge));
  }
  return least;
}

double area(const std::array<glm::dvec2, 4>& corners) {
  double twice = 0;
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % 4];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

TEST_F(DenoiseShape, RadialPassesFormTheProjectionOfARectangle) {
  const SlantedFloor floor;
  const auto corners = trapezoid(floor);
  // It is a trapezoid, not a rectangle: the near edge is a good deal longer.
  ASSERT_GT((corners[1].x - corners[0].x) / (corners[2].x - corners[3].x), 1.08);
  int covered = 0;
  std::array<double, 4> nearest{};
  nearest.fill(1e9);
  for (uint32_t y = 0; y < floor.size; ++y)
    for (uint32_t x = 0; x < floor.size; ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      const double inside = depth_inside(corners, centre);
      if (inside > 1) {
        EXPECT_GT(floor.response(x, y), 0) << x << " " << y;
      }
      if (inside < -1) {
        EXPECT_EQ(floor.response(x, y), 0) << x << " " << y;
      }
      if (floor.response(x, y) <= 0) continue;
      ++covered;
      for (size_t i = 0; i < 4; ++i)
        nearest[i] =
            std::min({nearest[i], std::max(std::abs(centre.x - corners[i].x), std::abs(centre.y - corners[i].y))});
    }
  for (size_t i = 0; i < 4; ++i) EXPECT_LT(nearest[i], 1.0) << "corner " << i;
  EXPECT_NEAR(covered / area(corners), 1, 0.06);
  EXPECT_GT(covered, 300);
}

/// Whole pixels that a segment of the floor crosses along the longer screen axis, and how near that is to one more.
struct Crossed {
  int count;
  double rest;
};
Crossed crossed(const SlantedFloor& floor, const glm::dvec3& from, const glm::dvec3& step) {
  const glm::dvec2 path = floor.camera.project(from + step) - floor.camera.project(from);
  const double length = std::max(std::abs(path.x), std::abs(path.y));
  return {static_cast<int>(length), length - std::floor(length)};
}

TEST_F(DenoiseShape, RadialPassesWeightAllPixelsOfARowAlike) {
  const SlantedFloor floor;
  const Crossed along = crossed(floor, {0, 0, 0}, {kAlong, 0, 0});
  double sum = 0;
  int rows = 0;
  for (uint32_t y = 0; y < floor.size; ++y) {
    // Where the row meets the floor under the middle of the screen.
    const glm::dvec3 ray =
        floor.camera.forward + floor.camera.up * ((1 - (y + 0.5) / (floor.size / 2.0)) * floor.camera.half_height);
    const glm::dvec3 point = floor.eye - ray * (floor.eye.y / ray.y);
    const Crossed up = crossed(floor, point, {0, 0, -kAcross}), down = crossed(floor, point, {0, 0, kAcross});
    const double expected = 1.0 / ((2 * along.count + 1) * (up.count + down.count + 1));
    for (uint32_t x = 0; x < floor.size; ++x) {
      const double value = floor.response(x, y);
      sum += value;
      if (value <= 0) continue;
      rows += x == floor.size / 2 ? 1 : 0;
      // A thousandth of a pixel: the device counts in floats.
      const double rest = std::min({up.rest, 1 - up.rest, down.rest, 1 - down.rest});
      // Away from the middle the bitangent leans over, but by less than its own length.
      if (rest > 1e-3) {
        EXPECT_NEAR(value / expected, 1, 1e-4) << x << " " << y;
      }
    }
  }
  EXPECT_GT(rows, 8);
  EXPECT_NEAR(sum, 1, 0.05) << "the far half of the plane gives a little more than the near one";
}

// --- A wall seen head on --------------------------------------------------------------------------------------------

TEST_F(DenoiseShape, RadialAndBoxBlurGiveATrapezoidInOneDimension) {
  const scene::Scene scene = wall(lambertian(glm::vec3(0.5f)));
  const int half = 9, radius = 3;
  const std::string reach = fixed_reach(scene, (half + 0.5) * pixel_size(3, 65));
  const Images images = run_filters(
      scene, {.stages = {{"denoise_radial", R"("axis": "tangent", "taps": 64, )" + reach},
                         {"box_blur", R"("axis": "x", "radius": )" + std::to_string(radius) + ", " + reach}}});
  for (int x = 0; x < 65; ++x) {
    int overlap = 0;
    for (int k = -radius; k <= radius; ++k) overlap += std::abs(x + k - 32) <= half ? 1 : 0;
    EXPECT_NEAR(images.at("radiance").at(static_cast<uint32_t>(x), 32, 0, 0),
                overlap / ((2.0 * half + 1) * (2.0 * radius + 1)), 1e-7)
        << x;
  }
}

TEST_F(DenoiseShape, VarianceOfNoiseFallsByTheNumberOfPixels) {
  const scene::Scene scene = wall(lambertian(glm::vec3(0.5f)));
  const std::string reach = fixed_reach(scene, 3.5 * pixel_size(3, 129));
  const Images images = run_filters(scene, {.size = 129, .pattern = "noise", .stages = both_radial(reach)});
  auto variance = [](const image::HostImage& image) {
    double sum = 0, squares = 0, count = 0;
    for (uint32_t y = 4; y < 125; ++y)
      for (uint32_t x = 4; x < 125; ++x)
        for (uint32_t c = 0; c < 3; ++c) {
          const double value = image.at(x, y, 0, c);
          sum += value;
          squares += value * value;
          ++count;
        }
    return squares / count - sum / count * (sum / count);
  };
  // 1 / sum w^2 = 7 * 7. The estimate from 3 * 121^2 / 49 independent values is off by 5 % (one sigma).
  EXPECT_NEAR(variance(images.at("pattern")) / variance(images.at("radiance")), 49, 49 * 0.15);
}

TEST_F(DenoiseShape, IsLinear) {
  const scene::Scene scene = wall(brushed(0.7f));
  std::vector<FilterStage> stages = both_radial(R"("floor_fraction": 0.008)");
  stages.push_back({"box_blur", R"("axis": "x")"});
  stages.push_back({"box_blur", R"("axis": "y")"});
  const Images noise = run_filters(scene, {.pattern = "noise", .stages = stages});
  const Images four_times = run_filters(scene, {.pattern = "noise", .scale = 4, .stages = stages});
  const Images impulse = run_filters(scene, {.pattern = "impulse", .stages = stages});
  const Images bump = run_filters(scene, {.pattern = "bump", .stages = stages});
  double most = 0;
  for (uint32_t y = 0; y < 65; ++y)
    for (uint32_t x = 0; x < 65; ++x) {
      EXPECT_EQ(four_times.at("radiance").at(x, y, 0, 0), 4 * noise.at("radiance").at(x, y, 0, 0));
      EXPECT_NEAR(bump.at("radiance").at(x, y, 0, 0) - 1, impulse.at("radiance").at(x, y, 0, 0) / 128, 3e-7);
      most = std::max(most, impulse.at("radiance").at(x, y, 0, 0));
    }
  EXPECT_LT(most, 0.2) << "there was something to filter";
}

TEST_F(DenoiseShape, ReachGrowsWithTheDistanceBeyondItsFloor) {
  // A 30th of the distance is 2.56 pixels of 65; nearer than 3 m a fixed 0.1 m is more.
  for (const float distance : {0.5f, 1.0f, 2.0f, 4.0f, 8.0f}) {
    const scene::Scene scene = wall(lambertian(glm::vec3(0.5f)), distance);
    std::string params = fixed_reach(scene, 0.1);
    params.replace(params.find(": 0,"), 4, ": 0.0333333333,");
    const double metres = std::max(0.1, distance / 30.0);
    const int expected = static_cast<int>(metres / pixel_size(distance, 65));
    const Images images = run_filters(scene, {.stages = both_radial(params)});
    EXPECT_EQ(reach_x(images.at("radiance")), expected) << distance;
    EXPECT_EQ(reach_y(images.at("radiance")), expected) << distance;
  }
}

// --- Lobes and kernels ----------------------------------------------------------------------------------------------

TEST_F(DenoiseShape, LobeAndKernelDecideTheReachAlongEachAxis) {
  // Alphas 1 and 0.25; a reach of 12.3 pixels at roughness 1.
  const scene::Scene scene = wall(brushed(0.5f));
  const std::string reach = fixed_reach(scene, 12.3 * pixel_size(3, 65));
  struct Row {
    std::string params;
    int along, across;
  };
  const std::vector<Row> rows = {
      {R"("lobe": "specular")", 12, 3},
      {R"("lobe": "both")", 12, 3},  // a metal has no other lobe
      {R"("lobe": "diffuse")", 12, 12},
      {R"("lobe": "specular", "kernel": "isotropic")", 6, 6},  // sqrt(1 * 0.25)
      {R"("lobe": "diffuse", "kernel": "isotropic")", 12, 12},
      {R"("lobe": "specular", "roughness": "perceptual")", 12, 6},
  };
  for (const Row& row : rows) {
    const Images images = run_filters(scene, {.stages = both_radial(row.params + ", " + reach)});
    EXPECT_EQ(reach_x(images.at("radiance")), row.along) << row.params;
    EXPECT_EQ(reach_y(images.at("radiance")), row.across) << row.params;
  }
}

TEST_F(DenoiseShape, EllipticCutoffKeepsABoxBlurOnTheGrain) {
  // Across the grain 0.6 pixels, along it 10.
  const scene::Scene scene = wall(brushed(0.245f));
  const std::string reach = fixed_reach(scene, 10.0 * pixel_size(3, 65));
  auto blur = [&](const std::string& axis, const std::string& cutoff) {
    return run_filters(scene, {.stages = {{"box_blur", R"("axis": ")" + axis + R"(", "cutoff": ")" + cutoff +
                                                           R"(", "lobe": "specular", )" + reach}}});
  };
  EXPECT_EQ(reach_y(blur("y", "radial").at("radiance")), 2);
  EXPECT_EQ(reach_y(blur("y", "elliptic").at("radiance")), 0);
  EXPECT_EQ(blur("y", "elliptic").at("radiance").at(32, 32, 0, 0), 1);
  EXPECT_EQ(reach_x(blur("x", "elliptic").at("radiance")), 2);
  // A round ellipse is the radial cut-off.
  const Images round = blur("x", R"(elliptic", "kernel": "isotropic)");
  EXPECT_EQ(reach_x(round.at("radiance")), 2);
}

}  // namespace
}  // namespace lightloom::test
