#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "framework/image/crop.hpp"
#include "framework/image/flicker.hpp"
#include "framework/image/frame_files.hpp"
#include "tests/image/image_fixture.hpp"
#include "tests/image/metric_images.hpp"

namespace lightloom::image {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Frames : public ::testing::Test {
 protected:
  void touch(std::initializer_list<const char*> names) {
    for (const char* name : names) std::ofstream(folder_ / name) << name;
  }
  std::vector<std::string> found(const std::string& place, const std::string& output = "radiance") {
    std::vector<std::string> result;
    for (const auto& [frame, file] : find_frames(folder_ / place, output).files)
      result.push_back(std::to_string(frame) + " " + file.filename().string());
    return result;
  }
  std::string refusal(const std::string& place, const std::string& output = "radiance") {
    try {
      (void)find_frames(folder_ / place, output);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      return std::string(error.what()) + " | " + error.hint();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
};

TEST_F(Frames, of_run_folders_are_those_of_the_output) {
  touch({"radiance.0000.exr", "radiance.0010.exr", "radiance.12345.exr", "radiance.001.exr", "radiance.exr",
         "radiance.0000.png", "image.0000.png", "image.0001.png", "albedo.0002.png", "run.json", "Xradiance.0003.exr"});
  EXPECT_THAT(found("."), ElementsAre("0 radiance.0000.exr", "10 radiance.0010.exr", "12345 radiance.12345.exr"));
  EXPECT_THAT(found(".", "image"), ElementsAre("0 image.0000.png", "1 image.0001.png"));
  EXPECT_FALSE(find_frames(folder_ / ".", "image").single);
  EXPECT_THAT(refusal(".", "imag"), HasSubstr("there are: Xradiance, albedo, image, radiance"));
}

TEST_F(Frames, of_patterns_are_the_files_that_fit) {
  touch({"a1.exr", "a02.exr", "a0003.exr", "a0004.exr", "a10000.exr", "a00005.exr", "b0001.exr", "a0006.png", "a.exr"});
  for (const char* pattern : {"a%04d.exr", "a####.exr"})
    EXPECT_THAT(found(pattern), ElementsAre("3 a0003.exr", "4 a0004.exr", "10000 a10000.exr"));
  EXPECT_THAT(found("a%d.exr"), ElementsAre("1 a1.exr", "10000 a10000.exr"));
  EXPECT_THAT(refusal("c####.exr"), HasSubstr("no file fits the pattern"));
  EXPECT_THAT(refusal("none/a####.exr"), HasSubstr("cannot read the folder"));
}

TEST_F(Frames, a_file_stands_for_itself) {
  touch({"a0003.exr", "50%.exr", "a##.exr", "a07.exr"});
  EXPECT_TRUE(find_frames(folder_ / "a0003.exr", "radiance").single);
  EXPECT_TRUE(find_frames(folder_ / "50%.exr", "radiance").single);
  EXPECT_TRUE(find_frames(folder_ / "a##.exr", "radiance").single) << "what exists is meant";
  EXPECT_TRUE(find_frames(folder_ / "missing.exr", "radiance").single) << "its reader says what is wrong";
}

TEST(FrameNumbers, are_put_into_patterns) {
  EXPECT_EQ(with_frame_number("out/h.####.png", 7), "out/h.0007.png");
  EXPECT_EQ(with_frame_number("out/h.%03d.png", 12345), "out/h.12345.png");
  EXPECT_EQ(with_frame_number("%d.png", 3), "3.png");
  EXPECT_EQ(with_frame_number("out####/h.png", 3), "out####/h.png");
  EXPECT_FALSE(has_frame_number("100%.png"));
  EXPECT_FALSE(has_frame_number("%s.png"));
}

HostImage grey(double value) {
  return constant_image(4, 3, {value, value, value});
}

TEST(Flicker, of_constant_frames_has_a_closed_form) {
  FlickerMeter meter;
  meter.add(grey(1));
  EXPECT_TRUE(std::isnan(meter.result().deviation));
  meter.add(grey(3));
  EXPECT_NEAR(meter.result().deviation, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(meter.result().step, 2, 1e-12);
  meter.add(grey(2));
  EXPECT_NEAR(meter.result().deviation, 1, 1e-12);
  EXPECT_NEAR(meter.result().step, 1.5, 1e-12);
}

TEST(Flicker, of_independent_noise_is_its_deviation) {
  FlickerMeter still, noisy;
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(1000, 0.25);
  for (int frame = 0; frame < 60; ++frame) {
    still.add(test_picture(48, 48, 1, 0, 1));
    noisy.add(grey_image(48, 48, [&](uint32_t, uint32_t) { return normal(generator); }));
  }
  EXPECT_EQ(still.result().deviation, 0);
  EXPECT_EQ(still.result().step, 0);
  EXPECT_NEAR(noisy.result().deviation, 0.25, 0.005);
  EXPECT_NEAR(noisy.result().step, 0.25 * 2 / std::sqrt(std::numbers::pi), 0.005);  // mean |difference| of two
}

TEST(Flicker, leaves_out_pixels_that_are_not_finite_in_some_frame) {
  FlickerMeter meter;
  for (const double value : {1.0, 5.0, 1.0}) {
    meter.add(color_image(2, 1, [&](uint32_t x, uint32_t) {
      const double bad = value == 5 ? std::numeric_limits<double>::infinity() : 0;
      return x == 0 ? Rgb{value, value, value} : Rgb{bad, 0, 0};
    }));
  }
  EXPECT_NEAR(meter.result().step, 4, 1e-6);
  EXPECT_THROW(meter.add(grey(1)), Error);
}

TEST(Crop, is_the_part_within_the_box) {
  const HostImage image = random_image(Format::rgba16_sfloat, Dimension::d2, {9, 7, 1}, 3);
  const HostImage part = crop(image, {2, 3, 5, 4});
  ASSERT_EQ(part.desc.extent, (Extent3{5, 4, 1}));
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 5; ++x)
      EXPECT_EQ(std::memcmp(part.texels.data() + (y * 5 + x) * 8, image.texels.data() + ((y + 3) * 9 + x + 2) * 8, 8),
                0);
  EXPECT_EQ(crop(image, {0, 0, 9, 7}).texels, image.texels);
  for (const PixelBox& bad :
       {PixelBox{5, 0, 5, 1}, PixelBox{0, 7, 1, 1}, PixelBox{0, 0, 0, 1}, PixelBox{0xFFFFFFFF, 0, 2, 1}})
    EXPECT_THROW((void)crop(image, bad), Error);
}

}  // namespace
}  // namespace lightloom::image
