// What the view passes show, against the values that they show.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <map>
#include <set>

#include "framework/base/error.hpp"
#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr double kByte = 1.01 / 255;
constexpr double kGrey = 0.35;
const glm::vec3 kEye(2.5f, 1.7f, 4);
constexpr float kFov = 0.9f;
/// Of the view in run_passes.
constexpr uint32_t kWidth = 64;
constexpr uint32_t kHeight = 48;

double srgb(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

glm::dvec3 color_at(const image::HostImage& image, uint32_t x, uint32_t y) {
  return {image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2)};
}

class ViewVoxels : public DeviceTest {
 protected:
  ViewVoxels() : scene_(make_triangle_scene(cube_triangles(1, glm::mat3(1)), {plain(glm::vec3(0.5f))})) {
    scene_.cameras = {look_at(kEye, {0, 0.1f, 0}, kFov)};
  }

  Images view(const std::string& params, double density = 0.06) const {
    return run_passes(R"("v": { "type": "voxel_pattern", "params": { "resolution": 16, "density": )" +
                          std::to_string(density) + R"( } },
      "d": { "type": "distance_transform", "in": { "voxels": "v.voxels" } },
      "view": { "type": "view_voxels", "in": { "voxels": "v.voxels", "distance": "d.distance" }, "params": { )" +
                          params + " } }",
                      "view.image", scene_);
  }

  scene::Scene scene_;
};

struct Seen {
  glm::ivec3 voxel{-1};
  int axis = -1;       ///< of the face, -1: nothing is hit
  double doubt = 1e9;  ///< how much nearer or further, or sideways, something else would have been seen [voxels]
};

/// The nearest of all occupied boxes that the ray meets, each by its own slabs.
Seen first_box(const image::HostImage& albedo, const glm::dvec3& origin, const glm::dvec3& direction) {
  Seen seen;
  double nearest = std::numeric_limits<double>::infinity();
  for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
    if (!occupied(albedo, voxel)) return;
    const glm::dvec3 a = (glm::dvec3(voxel) - origin) / direction;
    const glm::dvec3 b = (glm::dvec3(voxel) + 1.0 - origin) / direction;
    const glm::dvec3 in = glm::min(a, b);
    const glm::dvec3 out = glm::max(a, b);
    const double enter = std::max({in.x, in.y, in.z});
    const double leave = std::min({out.x, out.y, out.z});
    if (std::abs(leave - enter) < 1e-3) seen.doubt = 0;
    if (enter > leave || leave < 0) return;
    seen.doubt = std::min(seen.doubt, std::abs(enter - nearest));
    if (enter >= nearest) return;
    nearest = enter;
    seen.voxel = voxel;
    seen.axis = in.x == enter ? 0 : in.y == enter ? 1 : 2;
    std::array<double, 3> sorted = {in.x, in.y, in.z};
    std::sort(sorted.begin(), sorted.end());
    seen.doubt = std::min(seen.doubt, sorted[2] - sorted[1]);
  });
  return seen;
}

/// The pixel's ray, from the camera's parameters alone.
glm::dvec3 ray_direction(uint32_t x, uint32_t y) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0, 0.1f, 0) - glm::dvec3(kEye));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double scale = 2 * std::tan(kFov / 2) / kHeight;
  return glm::normalize(forward + right * ((x + 0.5 - kWidth * 0.5) * scale) -
                        up * ((y + 0.5 - kHeight * 0.5) * scale));
}

TEST_F(ViewVoxels, ShowsTheFirstVoxelOnEachPixelsRay) {
  const run::Grid grid = run::make_grid(scene_.bounds.min, scene_.bounds.max, 16);
  const glm::dvec3 origin = (glm::dvec3(kEye) - glm::dvec3(grid.origin)) / double(grid.voxel);
  const std::map<std::string, std::string> shades = {{"true", "faces darkened"}, {"false", "plain"}};
  for (const auto& [shaded, name] : shades) {
    SCOPED_TRACE(name);
    const Images images = view(R"("shade_faces": )" + shaded);
    const image::HostImage& albedo = images.at("v.voxels.albedo");
    uint32_t hits = 0, compared = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const Seen seen = first_box(albedo, origin, ray_direction(x, y));
        if (seen.doubt < 1e-3) continue;
        ++compared;
        hits += seen.axis >= 0 ? 1 : 0;
        glm::dvec3 expected(kGrey);
        const double shade = shaded == "true" && seen.axis >= 0 ? std::array{0.82, 1.0, 0.66}[size_t(seen.axis)] : 1;
        for (int channel = 0; seen.axis >= 0 && channel < 3; ++channel) {
          const double root = byte_at(albedo, seen.voxel, uint32_t(channel)) / 255.0;
          expected[channel] = shade * srgb(root * root);
        }
        const glm::dvec3 shown = color_at(images.at("output"), x, y);
        for (int channel = 0; channel < 3; ++channel)
          ASSERT_NEAR(shown[channel], expected[channel], kByte) << x << "," << y << " channel " << channel;
      }
    EXPECT_GT(compared, kWidth * kHeight * 9 / 10);
    EXPECT_GT(hits, 300u);
  }
}

/// Voxel that a slice shows in a pixel: the grid of 16 fills the height of 48, 3 pixels a voxel, 8 pixels beside it.
glm::ivec3 voxel_of_slice(char axis, double position, uint32_t x, uint32_t y) {
  const int right = x < 8 ? -1 : (int(x) - 8) / 3;
  const int down = int(y) / 3;
  const int along = std::min(int(position * 16), 15);
  if (axis == 'x') return {along, 15 - down, right};
  if (axis == 'y') return {right, along, down};
  return {right, 15 - down, along};
}

TEST_F(ViewVoxels, SlicesShowTheVoxelsOfOneLayer) {
  for (const char axis : {'x', 'y', 'z'})
    for (const double position : {0.0, 0.4, 1.0}) {
      const std::string cut = std::string(R"("cut": ")") + axis + R"(", "cut_position": )" + std::to_string(position);
      const Images material = view(R"("show": "material", )" + cut, 0.3);
      const Images distance = view(R"("show": "distance", )" + cut, 0.3);
      for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
          const glm::ivec3 voxel = voxel_of_slice(axis, position, x, y);
          const bool outside = std::min({voxel.x, voxel.y, voxel.z}) < 0 || std::max({voxel.x, voxel.y, voxel.z}) > 15;
          const bool full = !outside && occupied(material.at("v.voxels.albedo"), voxel);
          const double empty = outside ? 0 : byte_at(distance.at("d.distance"), voxel, 0);
          const glm::dvec3 shown = color_at(material.at("output"), x, y);
          const glm::dvec3 far = color_at(distance.at("output"), x, y);
          for (uint32_t channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(shown[int(channel)],
                        full ? byte_at(material.at("v.voxels.material"), voxel, channel) / 255.0 : kGrey, kByte)
                << axis << position << " " << x << "," << y;
          if (outside) {
            ASSERT_NEAR(far.x, kGrey, kByte);
          } else {
            ASSERT_NEAR(far.x, full ? 0 : 0.1 + 0.9 * (1 - 1 / empty), kByte)
                << axis << position << " " << x << "," << y;
          }
        }
    }
}

TEST_F(ViewVoxels, ThroughTheCameraDistanceIsItsMeanAlongTheRay) {
  // Without voxels every distance is the radius plus one.
  const Images empty = view(R"("show": "distance")", 0);
  EXPECT_NEAR(color_at(empty.at("output"), kWidth / 2, kHeight / 2).x, 0.1 + 0.9 * (1 - 1 / 5.0), kByte);
  const Images crowded = view(R"("show": "distance")", 0.2);
  EXPECT_LT(color_at(crowded.at("output"), kWidth / 2, kHeight / 2).x, 0.1 + 0.9 * (1 - 1 / 3.0));
}

class ViewSurface : public DeviceTest {
 protected:
  static scene::Scene boxes() {
    scene::Material red = lambertian({0.8f, 0.1f, 0.2f});
    scene::Material lamp = lambertian({0.2f, 0.4f, 0.6f});
    lamp.emission = {3, 0.5f, 1};
    return make_quad_scene({{{-2, -2, 0}, {2, 0, 0.5f}, {0, 4, 0}, 0},
                            {{0, -2, 0.5f}, {1.5f, 0, -1}, {0, 4, 0}, 1},
                            {{-1, -1, 1}, {1, 0, 0}, {0, 1, 0}, 0}},
                           {red, lamp}, look_at({0, 0, 5}, {0.2f, 0, 0}, 0.9f));
  }

  Images view(const std::string& show, const std::string& more = "") const {
    return run_passes(R"("g": { "type": "gather" }, "view": { "type": "view_surface", "in": { "surface": "g.surface")" +
                          more + R"( }, "params": { "show": ")" + show + R"(" } })",
                      "view.image", boxes());
  }

  /// Compares every pixel with `expected(x, y)`; the background must be grey.
  template <typename Expected>
  void expect_view(const std::string& show, const Expected& expected) const {
    SCOPED_TRACE(show);
    const Images images = view(show);
    uint32_t background = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const bool seen = images.at("g.surface.position").at(x, y, 0, 3) > 0;
        background += seen ? 0 : 1;
        const glm::dvec3 wanted = seen ? expected(images, x, y) : glm::dvec3(kGrey);
        const glm::dvec3 shown = color_at(images.at("output"), x, y);
        for (int channel = 0; channel < 3; ++channel)
          ASSERT_NEAR(shown[channel], wanted[channel], kByte) << x << "," << y << " channel " << channel;
      }
    EXPECT_GT(background, 100u);
    EXPECT_LT(background, kWidth * kHeight - 500);
  }

  static glm::dvec3 part(const Images& images, const std::string& name, uint32_t x, uint32_t y) {
    return color_at(images.at("g.surface." + name), x, y);
  }
};

TEST_F(ViewSurface, ShowsEachPartAsItsDocSays) {
  for (const std::string name : {"normal", "geometric_normal", "tangent"})
    expect_view(name, [&](const Images& i, uint32_t x, uint32_t y) { return part(i, name, x, y) * 0.5 + 0.5; });
  expect_view("albedo", [](const Images& i, uint32_t x, uint32_t y) {
    const glm::dvec3 linear = part(i, "albedo", x, y);
    return glm::dvec3(srgb(linear.x), srgb(linear.y), srgb(linear.z));
  });
  expect_view("emission", [](const Images& i, uint32_t x, uint32_t y) {
    const glm::dvec3 e = part(i, "emission", x, y);
    return glm::dvec3(srgb(e.x / (1 + e.x)), srgb(e.y / (1 + e.y)), srgb(e.z / (1 + e.z)));
  });
  expect_view("material", [](const Images& i, uint32_t x, uint32_t y) {
    const glm::dvec3 m = part(i, "material", x, y);
    return glm::dvec3(std::sqrt(m.x), std::sqrt(m.y), std::min(4 * m.z, 1.0));
  });
  const scene::Bounds bounds = boxes().bounds;
  expect_view("position", [&](const Images& i, uint32_t x, uint32_t y) {
    const glm::dvec3 p = part(i, "position", x, y);
    return glm::clamp((p - glm::dvec3(bounds.min)) / glm::dvec3(bounds.max - bounds.min), 0.0, 1.0);
  });
  const double scale = glm::distance(glm::dvec3(bounds.min), glm::dvec3(bounds.max)) / 8;
  expect_view("depth", [&](const Images& i, uint32_t x, uint32_t y) {
    return glm::dvec3(scale / (scale + i.at("g.surface.position").at(x, y, 0, 3)));
  });
}

TEST_F(ViewSurface, EveryObjectAndMaterialHasAColourOfItsOwn) {
  for (const uint32_t channel : {0u, 1u}) {
    const Images images = view(channel == 0 ? "object" : "material_id");
    std::map<double, std::set<std::array<double, 3>>> colors;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        if (images.at("g.surface.position").at(x, y, 0, 3) <= 0) continue;
        const glm::dvec3 shown = color_at(images.at("output"), x, y);
        colors[images.at("g.surface.id").at(x, y, 0, channel)].insert({shown.x, shown.y, shown.z});
      }
    EXPECT_EQ(colors.size(), channel == 0 ? 3u : 2u);
    std::set<std::array<double, 3>> all;
    for (const auto& [id, shown] : colors) {
      EXPECT_EQ(shown.size(), 1u) << id;
      all.insert(shown.begin(), shown.end());
    }
    EXPECT_EQ(all.size(), colors.size());
  }
}

TEST_F(ViewSurface, ShowsMotionByItsPixels) {
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  const Images images = run_passes(R"("g": { "type": "gather" },
    "m": { "type": "pattern", "in": { "surface": "g.surface" }, "params": { "pattern": "ramp" } },
    "view": { "type": "view_surface", "in": { "surface": "g.surface", "motion": "m.radiance" },
              "params": { "show": "motion" } })",
                                   "view.image", boxes(), options);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (images.at("g.surface.position").at(x, y, 0, 3) <= 0) continue;
      const double right = x / 16.0, down = y / 16.0;
      ASSERT_NEAR(images.at("output").at(x, y, 0, 0), 0.5 + 0.5 * right / (right + 8), kByte);
      ASSERT_NEAR(images.at("output").at(x, y, 0, 1), 0.5 + 0.5 * down / (down + 8), kByte);
    }
}

TEST_F(ViewSurface, MotionWithoutItsInputIsAClearError) {
  try {
    (void)view("motion");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_NE(std::string(error.what()).find("'motion' is not connected"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lightloom::test
