#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/shaders/statistics.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

class Random : public DeviceTest {
 protected:
  /// Four numbers for each of `count` keys; `key` is an expression of `index` that gives a RandomKey, and `rest` the
  /// bounce and dimension.
  static std::vector<float> draw(const std::string& key, const std::string& rest, uint32_t count) {
    const std::string body = "#include \"lib/random.glsl\"\nvoid evaluate(uint index) { vec4 r = random4(" + key +
                             ", " + rest + "); for (uint k = 0u; k < 4u; ++k) outputs[4u * index + k] = r[k]; }";
    const std::vector<float> none(1);
    return run_snippet(device(), body, none, 4 * size_t{count}, count);
  }

  static double correlation(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (size_t k = 0; k < a.size(); ++k) sum += (a[k] - 0.5) * (b[k] - 0.5);
    return 12 * sum / static_cast<double>(a.size());
  }
};

constexpr uint32_t kCount = 1u << 16;
const std::string kPixels = "RandomKey(uvec2(index & 255u, index >> 8u), 3u, 5u, 0u, 1u)";

TEST_F(Random, StaysBelowOne) {
  const std::vector<float> none(1);
  const std::vector<float> edge =
      run_snippet(device(),
                  "#include \"lib/random.glsl\"\nvoid evaluate(uint index) { outputs[index] = "
                  "uniform_floats(uvec4(0xFFFFFFFFu, 0u, 0x80000000u, 255u))[index]; }",
                  none, 4, 4);
  EXPECT_EQ(edge[0], 1.0f - 1.0f / 16777216.0f);
  EXPECT_EQ(edge[1], 0.0f);
  EXPECT_EQ(edge[2], 0.5f);
  EXPECT_EQ(edge[3], 0.0f);
}

TEST_F(Random, IsUniformInEachAndBetweenNumbers) {
  const std::vector<float> values = draw(kPixels, "0u, 0u", kCount);
  for (int first = 0; first < 4; ++first) {
    const int second = (first + 1) % 4;
    std::vector<double> observed(16 * 16), expected(16 * 16, kCount / 256.0);
    for (uint32_t k = 0; k < kCount; ++k) {
      ASSERT_GE(values[4 * k + first], 0.0f);
      ASSERT_LT(values[4 * k + first], 1.0f);
      ++observed[16 * static_cast<int>(16 * values[4 * k + first]) + static_cast<int>(16 * values[4 * k + second])];
    }
    EXPECT_GT(chi_square(observed, expected).p_value, 1e-4) << first;
  }
}

TEST_F(Random, EveryWordOfTheKeyMatters) {
  const std::vector<float> base = draw(kPixels, "1u, 1u", kCount);
  const std::vector<std::pair<std::string, std::string>> others = {
      {"RandomKey(uvec2((index & 255u) + 1u, index >> 8u), 3u, 5u, 0u, 1u)", "1u, 1u"},
      {"RandomKey(uvec2(index & 255u, (index >> 8u) + 1u), 3u, 5u, 0u, 1u)", "1u, 1u"},
      {"RandomKey(uvec2(index & 255u, index >> 8u), 4u, 5u, 0u, 1u)", "1u, 1u"},
      {"RandomKey(uvec2(index & 255u, index >> 8u), 3u, 6u, 0u, 1u)", "1u, 1u"},
      {"RandomKey(uvec2(index & 255u, index >> 8u), 3u, 5u, 1u, 1u)", "1u, 1u"},
      {kPixels, "2u, 1u"},
      {kPixels, "1u, 0u"},
  };
  const double limit = 4.5 / std::sqrt(4.0 * kCount);
  for (const auto& [key, rest] : others)
    EXPECT_LT(std::abs(correlation(base, draw(key, rest, kCount))), limit) << key << " " << rest;
}

// Along rows, columns, diagonals, frames and paths, near and far: a pattern would be seen as one in the picture, and
// would not average out over frames.
TEST_F(Random, NeighboursInSpaceAndTimeAreNotCorrelated) {
  struct Lag {
    const char* what;
    std::string key;
  };
  std::vector<Lag> lags;
  for (const char* step : {"1u", "2u", "7u", "8u", "64u"}) {
    const std::string s = step;
    lags.push_back({"row", "RandomKey(uvec2((index & 255u) + " + s + ", index >> 8u), 3u, 5u, 0u, 1u)"});
    lags.push_back({"column", "RandomKey(uvec2(index & 255u, (index >> 8u) + " + s + "), 3u, 5u, 0u, 1u)"});
    lags.push_back(
        {"diagonal", "RandomKey(uvec2((index & 255u) + " + s + ", (index >> 8u) + " + s + "), 3u, 5u, 0u, 1u)"});
    lags.push_back({"frame", "RandomKey(uvec2(index & 255u, index >> 8u), 3u + " + s + ", 5u, 0u, 1u)"});
    lags.push_back({"path", "RandomKey(uvec2(index & 255u, index >> 8u), 3u, 5u, " + s + ", 1u)"});
  }
  const std::vector<float> base = draw(kPixels, "0u, 1u", kCount);
  int beyond_two = 0;
  for (const Lag& lag : lags) {
    const double z = correlation(base, draw(lag.key, "0u, 1u", kCount)) * std::sqrt(4.0 * kCount);
    // Of 25 lags: none beyond 3.7 (one chance in 200), and about one beyond 2.
    EXPECT_LT(std::abs(z), 3.7) << lag.what << " " << lag.key;
    beyond_two += std::abs(z) > 2 ? 1 : 0;
  }
  EXPECT_LE(beyond_two, 5);
}

// The numbers that one pixel gets frame after frame, and path after path, fill the square: else its mean would be
// wrong.
TEST_F(Random, FirstPointsOfOnePixelFillTheSquare) {
  const std::vector<std::string> sequences = {"RandomKey(uvec2(321u, 123u), index, 5u, 0u, 1u)",
                                              "RandomKey(uvec2(321u, 123u), 0u, 5u, index, 1u)",
                                              "RandomKey(uvec2(0u, 0u), index, 0u, 0u, 1u)"};
  for (const std::string& key : sequences) {
    const std::vector<float> values = draw(key, "0u, 1u", 4096);
    for (int first = 0; first < 3; ++first) {
      std::vector<double> observed(256), expected(256, 16);
      for (size_t k = 0; k < values.size(); k += 4)
        ++observed[16 * static_cast<size_t>(16 * values[k + first]) + static_cast<size_t>(16 * values[k + first + 1])];
      EXPECT_GT(chi_square(observed, expected).p_value, 1e-4) << key << " " << first;
    }
    // One pair after another in time.
    std::vector<double> observed(256), expected(256, 4095.0 / 256);
    for (size_t k = 0; k + 4 < values.size(); k += 4)
      ++observed[16 * static_cast<size_t>(16 * values[k]) + static_cast<size_t>(16 * values[k + 4])];
    EXPECT_GT(chi_square(observed, expected).p_value, 1e-4) << key << " in time";
  }
}

}  // namespace
}  // namespace lightloom::test
