#include <gtest/gtest.h>

#include <algorithm>

#include "tests/passes/temporal_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = kTemporalSize;

class TemporalAccumulate : public DeviceTest {};

double luminance_variance(const image::HostImage& image) {
  // The three channels are independent and alike, so their mean says most.
  double sum = 0;
  for (uint32_t channel = 0; channel < 3; ++channel) sum += variance_of(image, channel) / 3;
  return sum;
}

TEST_F(TemporalAccumulate, FirstFrameIsTheCurrentOne) {
  const Images first = run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("noise"), 1).front();
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      ASSERT_EQ(first.at("radiance").at(x, y, 0, 0), first.at("current").at(x, y, 0, 0)) << x << " " << y;
}

TEST_F(TemporalAccumulate, LambertianNoiseFallsToATenth) {
  const std::vector<Images> frames = run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("noise"), 12);
  for (const uint32_t frame : {0u, 1u, 4u, 9u, 11u}) {
    const double used = std::min<double>(frame + 1.0, 10);
    EXPECT_NEAR(luminance_variance(frames[frame].at("radiance")) * used * 12, 1, 0.03) << frame;
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) ASSERT_EQ(frames[frame].at("radiance").at(x, y, 0, 3), used) << frame;
  }
}

TEST_F(TemporalAccumulate, MirrorShowsTheCurrentFrameAlone) {
  const Images last = run_temporal(wall(metal(0)), temporal_graph("noise"), 5).back();
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      for (uint32_t channel = 0; channel < 3; ++channel)
        ASSERT_EQ(last.at("radiance").at(x, y, 0, channel), last.at("current").at(x, y, 0, channel));
      ASSERT_EQ(last.at("radiance").at(x, y, 0, 3), 1);
    }
}

TEST_F(TemporalAccumulate, GlossyMetalFollowsTheHermiteFamily) {
  for (const float roughness : {0.5f, 0.7f, 0.9f}) {
    const Images last = run_temporal(wall(metal(roughness)), temporal_graph("noise"), 12).back();
    const double alpha = double{roughness} * roughness;
    EXPECT_NEAR(luminance_variance(last.at("radiance")) * 12 * effective_frames(alpha), 1, 0.03) << roughness;
    EXPECT_NEAR(last.at("radiance").at(kSize / 2, kSize / 2, 0, 3), weight_sum(alpha), 1e-2) << roughness;
  }
}

TEST_F(TemporalAccumulate, TheLobeDecidesHowLongLightIsKept) {
  scene::Material coated = lambertian(glm::vec3(0.5f));
  coated.roughness = 0.6f;
  const auto sum = [&](const scene::Material& material, const std::string& lobe) {
    const std::vector<Images> frames =
        run_temporal(wall(material), temporal_graph("noise", R"("lobe": ")" + lobe + "\""), 11);
    return frames.back().at("radiance").at(kSize / 2, kSize / 2, 0, 3);
  };
  EXPECT_EQ(sum(coated, "both"), 10) << "nothing specular is seen";
  EXPECT_NEAR(sum(coated, "specular"), weight_sum(0.36), 1e-2);
  EXPECT_EQ(sum(metal(0.6f), "diffuse"), 10);
  EXPECT_NEAR(sum(metal(0.6f), "specular"), weight_sum(0.36), 1e-2);
}

TEST_F(TemporalAccumulate, FramesThatSawAnotherPlaceAreLeftOut) {
  // The pattern is 1 in odd frames, and there the positions are wrong: only the even frames may be used.
  const std::vector<Images> frames =
      run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("frame", "", "moved.position"), 9);
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) ASSERT_EQ(frames[8].at("radiance").at(x, y, 0, 0), 0) << x << " " << y;
  EXPECT_EQ(frames[8].at("radiance").at(kSize / 2, kSize / 2, 0, 3), 5) << "frames 8, 6, 4, 2, 0";
}

TEST_F(TemporalAccumulate, OneSpoiltPixelDoesNotStay) {
  const Images last = run_temporal(wall(lambertian(glm::vec3(0.5f))), temporal_graph("spoilt"), 4).back();
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const bool spoilt = x == kSize / 2 && y == kSize / 2;  // in every frame
      ASSERT_EQ(last.at("radiance").at(x, y, 0, 0), spoilt ? 0 : 1) << x << " " << y;
      ASSERT_EQ(last.at("radiance").at(x, y, 0, 3), spoilt ? 0 : 4) << x << " " << y;
    }
}

}  // namespace
}  // namespace lightloom::test
