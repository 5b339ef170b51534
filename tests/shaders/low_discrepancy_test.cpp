// Numbers that are even over paths and pixels: shaders/lib/low_discrepancy.glsl and path_random.glsl.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/shaders/statistics.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

/// The numbers of a group that are drawn together.
constexpr std::pair<int, int> kPairs[] = {{1, 2}, {0, 3}};

class LowDiscrepancy : public DeviceTest {
 protected:
  /// Four numbers for each of `count` keys, an expression of `index`.
  static std::vector<float> draw(const std::string& key, uint32_t count) {
    const std::string body =
        "#include \"lib/path_random.glsl\"\nvoid evaluate(uint index) { vec4 r = uniform_floats(even_bits(" + key +
        ", 1u, 2u)); for (uint k = 0u; k < 4u; ++k) outputs[4u * index + k] = r[k]; }";
    const std::vector<float> none(1);
    return run_snippet(device(), body, none, 4 * size_t{count}, count);
  }

  /// Is there one point in every elementary interval of area 1 / (number of points)?
  static void expect_net(const std::vector<float>& values, const std::pair<int, int>& pair) {
    const auto count = static_cast<int>(values.size() / 4);
    for (int columns = 1; columns <= count; columns *= 2) {
      const int rows = count / columns;
      std::set<int> taken;
      for (int k = 0; k < count; ++k)
        taken.insert(static_cast<int>(values[4 * k + pair.first] * static_cast<float>(columns)) +
                     columns * static_cast<int>(values[4 * k + pair.second] * static_cast<float>(rows)));
      EXPECT_EQ(taken.size(), static_cast<size_t>(count)) << columns << " x " << rows;
    }
  }
};

TEST_F(LowDiscrepancy, PixelsOfATileAreANet) {
  for (const char* corner : {"uvec2(0u)", "uvec2(48u, 16u)", "uvec2(1912u, 1072u)"})
    for (const auto& pair : kPairs) {
      SCOPED_TRACE(corner);
      expect_net(draw("RandomKey(" + std::string(corner) + " + uvec2(index & 7u, index >> 3u), 7u, 3u, 0u, 1u)", 64),
                 pair);
    }
}

TEST_F(LowDiscrepancy, PathsOfAPixelAreANet) {
  for (const auto& pair : kPairs) expect_net(draw("RandomKey(uvec2(321u, 123u), 7u, 3u, index, 16u)", 16), pair);
}

TEST_F(LowDiscrepancy, PathsOfATileAreANet) {
  for (const auto& pair : kPairs)
    expect_net(draw("RandomKey(uvec2(36u, 20u) + uvec2((index >> 2u) & 3u, index >> 4u), 7u, 3u, index & 3u, 4u)", 64),
               pair);
}

/// As many paths as are no power of two are the first of a net that is larger.
TEST_F(LowDiscrepancy, PathsThatAreNoPowerOfTwoDoNotMeet) {
  const std::vector<float> values = draw("RandomKey(uvec2(4u + index / 15u, 6u), 7u, 3u, index % 15u, 15u)", 30);
  for (const auto& pair : kPairs) {
    std::set<int> taken;
    for (size_t k = 0; k < 30; ++k)
      taken.insert(static_cast<int>(values[4 * k + static_cast<size_t>(pair.first)] * 32));
    EXPECT_EQ(taken.size(), 30u);
  }
}

TEST_F(LowDiscrepancy, EachNumberIsUniformOverFramesAndSeeds) {
  constexpr uint32_t kCount = 1u << 15;
  for (const char* key :
       {"RandomKey(uvec2(321u, 123u), index, 5u, 2u, 15u)", "RandomKey(uvec2(9u), 4u, index, 0u, 1u)"}) {
    const std::vector<float> values = draw(key, kCount);
    for (size_t k = 0; k < 4; ++k) {
      std::vector<double> observed(64), expected(64, kCount / 64.0);
      for (size_t i = 0; i < kCount; ++i) ++observed[static_cast<size_t>(values[4 * i + k] * 64)];
      EXPECT_GT(chi_square(observed, expected).p_value, 1e-4) << key << " " << k;
      for (size_t other = 0; other < k; ++other) {
        double sum = 0;
        for (size_t i = 0; i < kCount; ++i) sum += (values[4 * i + k] - 0.5) * (values[4 * i + other] - 0.5);
        EXPECT_LT(std::abs(12 * sum / kCount), 5 / std::sqrt(kCount)) << key << " " << k << " and " << other;
      }
    }
  }
}

TEST_F(LowDiscrepancy, FramesAreIndependentOfEachOther) {
  constexpr uint32_t kCount = 1u << 15;
  const std::vector<float> now = draw("RandomKey(uvec2(321u, 123u), index, 5u, 0u, 1u)", kCount);
  const std::vector<float> next = draw("RandomKey(uvec2(321u, 123u), index + 1u, 5u, 0u, 1u)", kCount);
  for (size_t k = 0; k < 4; ++k) {
    double sum = 0;
    for (size_t i = 0; i < kCount; ++i) sum += (now[4 * i + k] - 0.5) * (next[4 * i + k] - 0.5);
    EXPECT_LT(std::abs(12 * sum / kCount), 5 / std::sqrt(kCount)) << k;
  }
}

}  // namespace
}  // namespace lightloom::test
