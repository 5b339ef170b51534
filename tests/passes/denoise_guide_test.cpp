#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/passes/filter_support.hpp"
#include "tests/support/device_fixture.hpp"

// The length of the filters where the variance of what they filter is known, by images or packed into one (the param).
namespace lightloom::test {
namespace {

class DenoiseGuide : public DeviceTest, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override { DeviceTest::SetUp(); }

  static constexpr double kReach = 12.3;  // pixels at full length

  const scene::Scene scene_ = make_quad_scene({{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}}, {lambertian(glm::vec3(0.5f))},
                                              look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
  const std::string reach_ = fixed_reach(scene_, kReach * 6 * std::tan(0.4) / 65);

  [[nodiscard]] FilterStage radial(const std::string& more = "") const {
    return {"denoise_radial", R"("axis": "tangent", "taps": 64, "difference_limit": 0, )" + reach_ + more};
  }

  /// A bump on an image that is 1 else, with the relative standard error `error` everywhere ("constant" is 0.25 in
  /// red).
  [[nodiscard]] image::HostImage bump(const FilterStage& stage, double error) const {
    return run_filters(scene_, {.pattern = "bump",
                                .stages = {stage},
                                .variance_pattern = "constant",
                                .variance_scale = 4 * error * error,
                                .packed = GetParam()})
        .at("radiance");
  }

  static int reach(const image::HostImage& image) {
    int count = 0;
    for (uint32_t x = 33; x < 65; ++x) count += image.at(x, 32, 0, 0) > 1 + 1e-5 ? 1 : 0;
    return count;
  }

  static void expect_same(const image::HostImage& a, const image::HostImage& b) {
    for (uint32_t y = 0; y < 65; ++y)
      for (uint32_t x = 0; x < 65; ++x)
        for (uint32_t c = 0; c < 4; ++c) ASSERT_EQ(a.at(x, y, 0, c), b.at(x, y, 0, c)) << x << " " << y << " " << c;
  }
};

TEST_P(DenoiseGuide, LengthFollowsTheRelativeStandardError) {
  for (const double error : {0.001, 0.02, 0.05, 0.08, 0.125, 0.18, 0.25, 2.0}) {
    const double x = std::min(error / 0.25, 1.0);
    const int expected = std::max(1, static_cast<int>(kReach * x * (2 - x)));
    EXPECT_EQ(reach(bump(radial(), error)), expected) << error;
    const double half = 1 + 0.5 * (x * (2 - x) - 1);
    EXPECT_EQ(reach(bump(radial(R"(, "variance_guide": 0.5)"), error)), std::max(1, static_cast<int>(kReach * half)));
  }
  EXPECT_EQ(reach(bump(radial(R"(, "full_width_error": 0.1)"), 0.05)), static_cast<int>(kReach * 0.75));
}

TEST_P(DenoiseGuide, BoxBlurShrinksToOnePixelAtMost) {
  const FilterStage box = {"box_blur", R"("axis": "x", "radius": 8, "difference_limit": 0, )" + reach_};
  EXPECT_EQ(reach(bump(box, 0.0)), 1);
  EXPECT_EQ(reach(bump(box, 0.125)), 6);  // 8 * 0.75
  EXPECT_EQ(reach(bump(box, 1.0)), 8);
  EXPECT_EQ(reach(bump({"box_blur", R"("axis": "x", "radius": 0, "difference_limit": 0, )" + reach_}, 1.0)), 0);
}

TEST_P(DenoiseGuide, WithoutKnowledgeTheFilterIsTheUnguidedOne) {
  const image::HostImage unguided = run_filters(scene_, {.pattern = "noise", .stages = {radial()}}).at("radiance");
  auto guided = [&](const std::string& more, const std::string& variance, double scale) {
    return run_filters(scene_, {.pattern = "noise",
                                .stages = {radial(more)},
                                .variance_pattern = variance,
                                .variance_scale = scale,
                                .packed = GetParam()})
        .at("radiance");
  };
  expect_same(unguided, guided("", "constant", 4e4));
  expect_same(unguided, guided(R"(, "variance_guide": 0)", "constant", 0));
  EXPECT_NE(unguided.texels, guided("", "constant", 0).texels);
}

TEST_P(DenoiseGuide, ConstantImagesStayAndImpulsesKeepTheirSum) {
  for (const double error : {0.0, 0.07, 1.0}) {
    const Images flat = run_filters(scene_, {.pattern = "constant",
                                             .stages = {radial(), {"box_blur", R"("axis": "y", )" + reach_}},
                                             .variance_pattern = "noise",
                                             .variance_scale = error,
                                             .packed = GetParam()});
    const image::HostImage response = bump(radial(), error);
    double sum = 0;
    for (uint32_t y = 0; y < 65; ++y)
      for (uint32_t x = 0; x < 65; ++x) {
        EXPECT_NEAR(flat.at("radiance").at(x, y, 0, 0), 0.25, 1e-6);
        sum += 128 * (response.at(x, y, 0, 0) - 1);
      }
    EXPECT_NEAR(sum, 1, 5e-3) << error;
  }
}

TEST_P(DenoiseGuide, AStepStaysWhereChanceCannotExplainIt) {
  // From 1 to 2: with the variance v of each, that is 1 / sqrt(2 v) standard errors.
  auto step = [&](double standard_errors, const std::string& limit) {
    const FilterStage stage = {"denoise_radial",
                               R"("axis": "tangent", "taps": 64, "variance_guide": 0, )" + reach_ + limit};
    return run_filters(scene_,
                       {.pattern = "step",
                        .stages = {stage, {"box_blur", R"("axis": "x", "variance_guide": 0, )" + reach_ + limit}},
                        .variance_pattern = "constant",
                        .variance_scale = 4 * 0.5 / (standard_errors * standard_errors),
                        .packed = GetParam()});
  };
  const Images sharp = step(3.1, "");
  const Images blurred = step(2.9, "");
  const Images unlimited = step(3.1, R"(, "difference_limit": 0)");
  expect_same(sharp.at("radiance"), sharp.at("pattern"));
  expect_same(blurred.at("radiance"), unlimited.at("radiance"));
  EXPECT_NEAR(blurred.at("radiance").at(32, 32, 0, 0), 1.5, 0.05);
  expect_same(step(1.9, R"(, "difference_limit": 2)").at("radiance"), unlimited.at("radiance"));
  expect_same(step(2.1, R"(, "difference_limit": 2)").at("radiance"), sharp.at("pattern"));
}

TEST_P(DenoiseGuide, WithLittleHistoryTheLimitIsWide) {
  // The bump is 1/128 high and its alpha is 1: kept apart beyond 5 standard errors of the difference, not beyond 3.
  const FilterStage stage = {"denoise_radial", R"("axis": "tangent", "taps": 64, "variance_guide": 0, )" + reach_};
  const double height = 1.0 / 128;
  EXPECT_EQ(reach(bump(stage, height / std::sqrt(2.0) / 4.5)), 12);
  EXPECT_EQ(reach(bump(stage, height / std::sqrt(2.0) / 5.5)), 0);
}

TEST_P(DenoiseGuide, WhatIsImprobablyBrightKeepsItsSum) {
  // One pixel in which chance found much light, and so much variance: spread, neither lost nor left alone.
  const Images images = run_filters(
      scene_, {.pattern = "impulse",
               .stages = {{"denoise_radial", R"("axis": "tangent", "taps": 64, "variance_guide": 0, )" + reach_}},
               .variance_pattern = "impulse",
               .packed = GetParam()});
  double sum = 0;
  for (uint32_t x = 0; x < 65; ++x) sum += images.at("radiance").at(x, 32, 0, 0);
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_NEAR(images.at("radiance").at(32, 32, 0, 0), 1.0 / 25, 1e-6);
}

TEST_P(DenoiseGuide, ASpoiltVarianceCountsAsNone) {
  // One NaN in the variance: its neighbours judge by the other eight pixels.
  const Images images = run_filters(scene_, {.pattern = "noise",
                                             .stages = {radial()},
                                             .variance_pattern = "spoilt",
                                             .variance_scale = 1,
                                             .packed = GetParam()});
  const Images clean = run_filters(scene_, {.pattern = "noise", .stages = {radial()}});
  expect_same(images.at("radiance"), clean.at("radiance"));
}

TEST_P(DenoiseGuide, AGuideOfNoVarianceLeavesTheFullLength) {
  const image::HostImage plain = run_filters(scene_, {.pattern = "noise", .stages = {radial()}}).at("radiance");
  expect_same(plain,
              run_filters(scene_, {.pattern = "noise", .stages = {radial()}, .packed = GetParam()}).at("radiance"));
}

INSTANTIATE_TEST_SUITE_P(Variance, DenoiseGuide, ::testing::Bool(),
                         [](const auto& given) { return given.param ? "Packed" : "InImages"; });

}  // namespace
}  // namespace lightloom::test
