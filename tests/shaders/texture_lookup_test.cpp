#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

using TextureLookupTest = DeviceTest;

constexpr int kTexels = 8;

/// The texel (of 8) that Vulkan's address modes give for integer texel coordinate i; mode 0 repeat, 1 clamp, 2 mirror.
int addressed(int i, int mode) {
  if (mode == 1) return std::clamp(i, 0, kTexels - 1);
  const int period = mode == 2 ? 2 * kTexels : kTexels;
  const int r = ((i % period) + period) % period;
  return r < kTexels ? r : period - 1 - r;
}

TEST_F(TextureLookupTest, WrappedCoordinatesFilterAsTheSamplerModesDo) {
  // Linear filtering at a wrapped coordinate under a repeating sampler, against filtering with Vulkan's address modes.
  const std::string body = R"(
#include "lib/textures.glsl"
void evaluate(uint index) { outputs[index] = wrap_coordinate(inputs[2 * index], uint(inputs[2 * index + 1]), 8.0); }
)";
  std::vector<float> inputs;
  for (int mode = 0; mode < 3; ++mode) {
    for (int step = -330; step <= 330; ++step) {
      inputs.push_back(static_cast<float>(step) / 100.0f + 0.0013f);
      inputs.push_back(static_cast<float>(mode));
    }
  }
  const size_t count = inputs.size() / 2;
  const std::vector<float> out = run_snippet(device(), body, inputs, count, static_cast<uint32_t>(count));
  const auto texel = [](int i) { return std::sin(1.7 * i); };
  const auto filtered = [&](double coordinate, int mode) {
    const double x = coordinate * kTexels - 0.5;
    const int i = static_cast<int>(std::floor(x));
    return texel(addressed(i, mode)) * (i + 1 - x) + texel(addressed(i + 1, mode)) * (x - i);
  };
  for (size_t k = 0; k < count; ++k) {
    const int mode = static_cast<int>(inputs[2 * k + 1]);
    EXPECT_NEAR(filtered(static_cast<double>(out[k]), 0), filtered(static_cast<double>(inputs[2 * k]), mode), 1e-4)
        << "coordinate " << inputs[2 * k] << " mode " << mode;
  }
}

TEST_F(TextureLookupTest, LevelOfDetailIsTheLogarithmOfTheTexelsBetweenSamples) {
  const std::string body = R"(
#include "lib/textures.glsl"
void evaluate(uint index) {
  vec2 dx = vec2(inputs[4 * index], inputs[4 * index + 1]);
  vec2 dy = vec2(inputs[4 * index + 2], inputs[4 * index + 3]);
  outputs[index] = texture_lod(dx, dy, vec2(256.0, 64.0));
})";
  const std::vector<float> inputs = {1 / 256.0f, 0, 0, 1 / 64.0f,  // one texel
                                     4 / 256.0f, 0, 0, 1 / 64.0f,  // four along u
                                     0,          0, 0, 0.5f,       // 32 along v
                                     1e-9f,      0, 0, 0,          // magnified
                                     0,          0, 0, 0,         1e9f, 0, 0, 0};
  const std::vector<float> out = run_snippet(device(), body, inputs, 6, 6);
  const std::vector<float> expected = {0, 2, 5, 0, 0, 16};
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(out[i], expected[i], 1e-3) << i;
}

}  // namespace
}  // namespace lightloom::test
