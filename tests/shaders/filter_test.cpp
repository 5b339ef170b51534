#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

class Filter : public DeviceTest {
 protected:
  /// Weights of ages 0 to 9 of 10 frames.
  static std::vector<float> weights(float roughness) {
    const std::vector<float> input = {roughness};
    return run_snippet(device(),
                       "#include \"lib/filter.glsl\"\nvoid evaluate(uint index) { outputs[index] = "
                       "history_weight(float(index), 10.0, inputs[0]); }",
                       input, 10, 10);
  }
  /// How many frames of equal weight have the same noise: (sum w)^2 / sum w^2.
  static double effective_frames(const std::vector<float>& w) {
    double sum = 0, squares = 0;
    for (const double v : w) {
      sum += v;
      squares += v * v;
    }
    return sum * sum / squares;
  }
};

TEST_F(Filter, LambertianSurfaceUsesAllFramesAlike) {
  for (const float w : weights(1)) EXPECT_EQ(w, 1.0f);
  EXPECT_DOUBLE_EQ(effective_frames(weights(1)), 10);
}

TEST_F(Filter, MirrorUsesTheCurrentFrameAlone) {
  const std::vector<float> w = weights(0);
  EXPECT_EQ(w[0], 1.0f);
  EXPECT_DOUBLE_EQ(effective_frames(w), 1);
}

TEST_F(Filter, HalfRoughSurfaceFollowsTheHermiteCurve) {
  const std::vector<float> w = weights(0.5f);
  for (int age = 0; age < 10; ++age) {
    const double x = age / 10.0;
    EXPECT_NEAR(w[age], 1 - 3 * x * x + 2 * x * x * x, 1e-6) << age;
  }
}

TEST_F(Filter, RougherSurfacesUseMoreHistory) {
  double before = 0;
  for (const float roughness : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 0.9f, 1.0f}) {
    const double frames = effective_frames(weights(roughness));
    EXPECT_GT(frames, before) << roughness;
    before = frames;
  }
}

TEST_F(Filter, LambertianShareHidesTheLobesRoughness) {
  const std::vector<float> none(1);
  const std::vector<float> r = run_snippet(device(),
                                           "#include \"lib/filter.glsl\"\nvoid evaluate(uint index) { vec2 r = "
                                           "filter_roughness(vec2(0.1, 0.4), 0.5 * float(index)); outputs[2u * index] "
                                           "= r.x; outputs[2u * index + 1u] = r.y; }",
                                           none, 6, 3);
  const std::vector<double> expected = {1, 1, 0.94375, 0.9625, 0.1, 0.4};
  for (size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(r[k], expected[k], 1e-6) << k;
}

TEST_F(Filter, FootprintIsThePixelsWidth) {
  // f = 2 across 3 to 4: clip = (f x 3/4, -f y, ., depth), 400 x 300 pixels; a pixel at depth 6 is 2 * 6 / (1.5 * 400).
  const std::vector<float> none(1);
  const std::vector<float> width = run_snippet(
      device(),
      "#include \"lib/filter.glsl\"\nvoid evaluate(uint index) { mat4 m = mat4(0.0); m[0].x = 1.5; m[1].y = -2.0; "
      "m[2].w = -1.0; outputs[0] = pixel_footprint(m, 6.0, vec2(400.0, 300.0)); vec2 p = clip_to_pixel(m * vec4(1.0, "
      "-1.0, -6.0, 1.0), vec2(400.0, 300.0)); outputs[1] = p.x; outputs[2] = p.y; }",
      none, 3, 1);
  EXPECT_NEAR(width[0], 0.02, 1e-6);
  EXPECT_NEAR(width[1], 250, 1e-3);
  EXPECT_NEAR(width[2], 200, 1e-3);
}

}  // namespace
}  // namespace lightloom::test
