#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

struct Size {
  uint32_t width, height;
};

struct UpsampleRun {
  std::string pattern;
  Size view, trace;
  std::string params = {};
  std::string specular_pattern = {};  ///< empty: unconnected
};

/// Outputs `radiance`, `low` (what was traced) and `full` (the pattern at full size), `specular` and `specular_low`
/// where there is one.
Images upsample(const scene::Scene& scene, const UpsampleRun& run) {
  const auto pattern = [](const std::string& name, const std::string& from, const std::string& which) {
    return "\"" + name + R"(": { "type": "pattern", "in": { "surface": ")" + from +
           R"(.surface" }, "params": { "pattern": ")" + which + "\" } }, ";
  };
  std::string passes = R"("gather": { "type": "gather" },
    "trace_surface": { "type": "resample_surface", "in": { "surface": "gather.surface" } }, )" +
                       pattern("pattern", "trace_surface", run.pattern) + pattern("full", "gather", run.pattern);
  std::string outputs = R"("radiance": "upsample.radiance", "full": "full.radiance", "low": "pattern.radiance")";
  std::string specular;
  if (!run.specular_pattern.empty()) {
    passes += pattern("specular", "trace_surface", run.specular_pattern);
    specular = R"(, "specular": "specular.radiance")";
    outputs += R"(, "specular": "upsample.specular", "specular_low": "specular.radiance")";
  }
  passes += R"("upsample": { "type": "upsample", "in": { "radiance": "pattern.radiance",
    "trace_surface": "trace_surface.surface", "surface": "gather.surface")" +
            specular + " }, \"params\": { " + run.params + " } }";
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  options.capture = {"gather.surface.position", "gather.surface.id", "trace_surface.surface.id"};
  return run_graph(graph_text(run.view.width, run.view.height, run.trace.width, run.trace.height, passes, outputs),
                   scene, options)
      .front();
}

class Upsample : public DeviceTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override { DeviceTest::SetUp(); }
  static std::string filter() { return R"("filter": ")" + GetParam() + "\""; }
};
INSTANTIATE_TEST_SUITE_P(Filters, Upsample, ::testing::Values("bilateral", "nearest"),
                         [](const auto& row) { return row.param; });

/// Calls `check(x, y)` for every pixel that shows a surface; returns how many there are.
template <typename Check>
int for_surface(const Images& images, const Check& check) {
  const image::HostImage& position = images.at("gather.surface.position");
  int count = 0;
  for (uint32_t y = 0; y < position.desc.extent.height; ++y)
    for (uint32_t x = 0; x < position.desc.extent.width; ++x) {
      if (position.at(x, y, 0, 3) <= 0) continue;
      ++count;
      check(x, y);
    }
  return count;
}

/// A slanted post before a wall, with background around.
scene::Scene post() {
  return make_quad_scene({{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, {{-0.4f, -0.8f, 1}, {0.35f, 0, 0}, {0.5f, 1.5f, 0.3f}}},
                         {lambertian(glm::vec3(0.5f))}, look_at({0.2f, 0.1f, 4}, {0, 0, 0}, 0.8f));
}

scene::Scene wall() {
  return make_quad_scene({{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}}, {lambertian(glm::vec3(0.5f))},
                         look_at({0.3f, 0.1f, 3}, {0, 0, 0}, 0.8f));
}

TEST_P(Upsample, IsTheIdentityAtEqualSizes) {
  for (const Size size : {Size{60, 60}, Size{61, 37}, Size{16, 45}}) {
    const Images images = upsample(
        post(), {.pattern = "noise", .view = size, .trace = size, .params = filter(), .specular_pattern = "ramp"});
    const int surfaces = for_surface(images, [&](uint32_t x, uint32_t y) {
      for (uint32_t c = 0; c < 4; ++c) {
        ASSERT_EQ(images.at("radiance").at(x, y, 0, c), images.at("low").at(x, y, 0, c));
        ASSERT_EQ(images.at("specular").at(x, y, 0, c), images.at("specular_low").at(x, y, 0, c));
      }
    });
    EXPECT_GT(surfaces, 100);
  }
}

TEST_P(Upsample, BackgroundIsBlack) {
  const Images images =
      upsample(post(), {.pattern = "constant", .view = {96, 96}, .trace = {48, 48}, .params = filter()});
  for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(images.at("radiance").at(0, 0, 0, c), 0);
}

TEST_P(Upsample, TakesValuesOfTheSameObjectAlone) {
  for (const Size trace : {Size{24, 24}, Size{33, 32}, Size{48, 31}}) {
    const Images images = upsample(post(), {.pattern = "object", .view = {96, 96}, .trace = trace, .params = filter()});
    for_surface(images, [&](uint32_t x, uint32_t y) {
      ASSERT_EQ(images.at("radiance").at(x, y, 0, 0), images.at("full").at(x, y, 0, 0)) << x << " " << y;
      ASSERT_EQ(images.at("radiance").at(x, y, 0, 1), images.at("full").at(x, y, 0, 1)) << x << " " << y;
    });
  }
}

TEST_P(Upsample, TakesAnotherObjectOnlyWhereTheSearchMeetsNoneOfItsOwn) {
  // Slats thinner than a traced pixel, at a right angle to the wall behind, so that their normals are unlike.
  std::vector<QuadSpec> quads = {{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}};
  for (int i = 0; i < 9; ++i)
    quads.push_back({{-1.2f + 0.31f * static_cast<float>(i), -1, 0.9f}, {0, 0, -0.5f}, {0, 2, 0}});
  const scene::Scene slats =
      make_quad_scene(quads, {lambertian(glm::vec3(0.5f))}, look_at({0.2f, 0.1f, 4}, {0, 0, 0}, 0.8f));
  const int rings = 2;
  const Images images = upsample(
      slats, {.pattern = "object", .view = {160, 120}, .trace = {40, 30}, .params = filter() + R"(, "rings": 2)"});
  int of_its_own = 0, of_another = 0;
  for_surface(images, [&](uint32_t x, uint32_t y) {
    const double id = images.at("gather.surface.id").at(x, y, 0, 0);
    bool met = false;
    for (int dy = -rings; dy <= rings; ++dy)
      for (int dx = -rings; dx <= rings; ++dx) {
        const int u = static_cast<int>((x + 0.5) / 4) + dx, v = static_cast<int>((y + 0.5) / 4) + dy;
        if (u < 0 || v < 0 || u >= 40 || v >= 30) continue;
        met = met ||
              images.at("trace_surface.surface.id").at(static_cast<uint32_t>(u), static_cast<uint32_t>(v), 0, 0) == id;
      }
    if (!met) {
      ++of_another;
      return;
    }
    ++of_its_own;
    ASSERT_EQ(images.at("radiance").at(x, y, 0, 0), images.at("full").at(x, y, 0, 0)) << x << " " << y;
  });
  EXPECT_GT(of_its_own, 10000);
  EXPECT_GT(of_another, 0) << "the scene is meant to have both";
}

/// Largest distance from a ramp over the traced pixels, in traced pixels, away from the border by one of them.
double ramp_error(const Images& images, Size view, Size trace) {
  double worst = 0;
  const double per_x = static_cast<double>(trace.width) / view.width,
               per_y = static_cast<double>(trace.height) / view.height;
  for_surface(images, [&](uint32_t x, uint32_t y) {
    const double u = (x + 0.5) * per_x - 0.5, v = (y + 0.5) * per_y - 0.5;
    if (u < 0 || v < 0 || u > trace.width - 1 || v > trace.height - 1) return;
    worst = std::max({worst, std::abs(images.at("radiance").at(x, y, 0, 0) * 16 - u),
                      std::abs(images.at("radiance").at(x, y, 0, 1) * 16 - v)});
  });
  return worst;
}

TEST_P(Upsample, KeepsARampOnAPlane) {
  for (const auto& [view, trace] : {std::pair{Size{96, 96}, Size{48, 48}}, std::pair{Size{101, 67}, Size{33, 31}},
                                    std::pair{Size{160, 90}, Size{64, 48}}, std::pair{Size{47, 53}, Size{96, 80}}}) {
    const Images images = upsample(wall(), {.pattern = "ramp", .view = view, .trace = trace, .params = filter()});
    // The nearest traced pixel is up to half a pixel away; smooth is what interpolates.
    EXPECT_LE(ramp_error(images, view, trace), GetParam() == "nearest" ? 0.5 + 1e-5 : 1e-3) << view.width;
  }
}

TEST_P(Upsample, FillsTheSizesThatPeopleAskFor) {
  for (const Size view : {Size{1280, 960}, Size{1920, 1080}}) {
    const Images images = upsample(wall(), {.pattern = "ramp", .view = view, .trace = {640, 480}, .params = filter()});
    const int surfaces = for_surface(images, [](uint32_t, uint32_t) {});
    EXPECT_EQ(surfaces, static_cast<int>(view.width * view.height));
    EXPECT_LE(ramp_error(images, view, {640, 480}), GetParam() == "nearest" ? 0.51 : 0.01);
  }
}

TEST_P(Upsample, BringsASecondImageAlong) {
  const UpsampleRun both = {
      .pattern = "noise", .view = {96, 96}, .trace = {48, 31}, .params = filter(), .specular_pattern = "object"};
  UpsampleRun alone = both;
  alone.pattern = both.specular_pattern;
  alone.specular_pattern.clear();
  scene::Scene scene = post();
  EXPECT_EQ(upsample(scene, both).at("specular").texels, upsample(scene, alone).at("radiance").texels);
  scene.features.specular = false;
  const Images without = upsample(scene, both);
  for_surface(without, [&](uint32_t x, uint32_t y) {
    for (uint32_t c = 0; c < 4; ++c) ASSERT_EQ(without.at("specular").at(x, y, 0, c), 0);
  });
}

TEST_F(Upsample, BlendIsSmoothWhereTheNearestPixelIsBlocky) {
  const Size view = {96, 96}, trace = {32, 32};
  const Images smooth = upsample(wall(), {.pattern = "noise", .view = view, .trace = trace});
  const Images blocky =
      upsample(wall(), {.pattern = "noise", .view = view, .trace = trace, .params = R"("filter": "nearest")"});
  auto steps = [](const image::HostImage& image) {
    int count = 0;
    for (uint32_t x = 1; x < 96; ++x) count += image.at(x, 48, 0, 0) != image.at(x - 1, 48, 0, 0) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(steps(blocky.at("radiance")), 31);
  EXPECT_GT(steps(smooth.at("radiance")), 80);
}

}  // namespace
}  // namespace lightloom::test
