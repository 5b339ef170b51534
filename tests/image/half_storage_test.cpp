// Why sums over many frames are not stored in half floats: what happens to a mean and to an exponential average that
// are.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/image/half.hpp"

namespace lightloom::image {
namespace {

float stored(float value) {
  return float_from_half(half_from_float(value));
}

TEST(HalfStorage, ARunningMeanStallsAfterFortyFiveFrames) {
  float mean = 1;
  int frame = 1;
  for (;; ++frame) {
    const float next = stored(mean + (2 - mean) / static_cast<float>(frame + 1));
    if (next == mean) break;
    mean = next;
  }
  EXPECT_EQ(frame + 1, 45);
  EXPECT_NEAR(mean, 1.978516f, 1e-6f);
}

TEST(HalfStorage, AnExponentialAverageStopsShortOfItsLimit) {
  const std::pair<float, float> cases[] = {
      {0.2f, 0.999023f}, {0.1f, 0.998047f}, {0.05f, 0.995117f}, {0.01f, 0.975586f}};
  for (const auto& [share, limit] : cases) {
    float average = 0;
    for (int frame = 0; frame < 100'000; ++frame) average = stored(average + share * (1 - average));
    EXPECT_NEAR(average, limit, 1e-6f) << share;
  }
}

TEST(HalfStorage, ASumStopsWhereAStepIsLessThanHalfASpacing) {
  float sum = 0;
  for (int frame = 0; frame < 10'000; ++frame) sum = stored(sum + 1);
  EXPECT_EQ(sum, 2048);
}

}  // namespace
}  // namespace lightloom::image
