#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/passes/temporal_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = kTemporalSize;

class TemporalVariance : public DeviceTest {};

double mean_estimate(const Images& images) {
  double sum = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) sum += images.at("variance").at(x, y, 0, 0);
  return sum / (kSize * kSize);
}

TEST_F(TemporalVariance, IsWithoutBiasForAnyNumberOfFrames) {
  const std::vector<Images> frames = run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("noise"), 11);
  for (uint32_t frame = 0; frame < frames.size(); ++frame) {
    const double expected = kNoiseVariance / std::min<double>(frame + 1.0, 10);
    EXPECT_NEAR(mean_estimate(frames[frame]) / expected, 1, 0.04) << frame;
  }
}

TEST_F(TemporalVariance, UnequalWeightsNeedTheirOwnSmallSampleFactor) {
  // Worth 5.9 frames at alpha 0.5 and 1.5 at alpha 0.15: the frames themselves, and the neighbours.
  for (const float roughness : {0.707107f, 0.387298f}) {
    const Images last = run_temporal(wall(metal(roughness)), temporal_graph("noise"), 11).back();
    const double alpha = double{roughness} * roughness;
    EXPECT_NEAR(mean_estimate(last) / (kNoiseVariance / effective_frames(alpha)), 1, 0.04) << roughness;
  }
}

TEST_F(TemporalVariance, IsNoughtWhereNothingVaries) {
  const std::vector<Images> frames = run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("constant"), 6);
  for (const uint32_t frame : {0u, 5u})
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) ASSERT_LT(frames[frame].at("variance").at(x, y, 0, 0), 1e-12);
}

TEST_F(TemporalVariance, NeighboursOnAnotherObjectDoNotCount) {
  // Two quads of one plane; the pattern is red on the first and green on the second.
  scene::Scene scene = make_quad_scene({{{-2, -2, 0}, {2, 0, 0}, {0, 4, 0}}, {{0, -2, 0}, {2, 0, 0}, {0, 4, 0}}}, {},
                                       look_at({0.3f, 0.2f, 3}, {0, 0, 0}, 0.8f));
  const Images first = run_temporal(scene, temporal_graph("object"), 1).front();
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) ASSERT_EQ(first.at("variance").at(x, y, 0, 0), 0) << x << " " << y;
}

TEST_F(TemporalVariance, IsUnknownForOnePixelAloneAndForAPassThatIsOff) {
  std::string lonely = temporal_graph("noise");
  for (size_t at = 0; (at = lonely.find(std::to_string(kSize), at)) != std::string::npos;) lonely.replace(at, 2, "1");
  const std::vector<Images> frames = run_temporal(wall(lambertian(glm::vec3(0.5f))), lonely, 5);
  EXPECT_EQ(frames[0].at("variance").at(0, 0, 0, 0), 1e36f);
  EXPECT_LT(frames[4].at("variance").at(0, 0, 0, 0), 1) << "five frames say something";
  LinkOptions off;
  off.disables = {"temporal"};
  EXPECT_EQ(run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("noise"), 1, off)
                .front()
                .at("variance")
                .at(3, 5, 0, 0),
            1e36f);
}

}  // namespace
}  // namespace lightloom::test
