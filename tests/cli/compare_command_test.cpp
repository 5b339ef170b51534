#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/base/text.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/metrics.hpp"
#include "framework/image/npy.hpp"
#include "framework/image/png.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/image/metric_images.hpp"

namespace lightloom::cli {
namespace {

using image::HostImage;
using image::Rgb;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kKeys = {"mse",  "rmse",       "psnr",      "relmse",    "mape",       "smape", "ssim",
                                        "flip", "mean_error", "max_error", "fireflies", "non_finite", "bias"};

class CompareCommand : public ProgramTest {
 protected:
  CompareCommand() : ProgramTest({"compare"}) {}

  std::string path(const std::string& name) { return (folder_ / name).string(); }
  std::string exr(const std::string& name, const HostImage& image) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    image::write_exr(folder_ / name, image, {"R", "G", "B", "A"});
    return path(name);
  }
  std::string png(const std::string& name, uint8_t value) {
    HostImage image{{Format::rgba8_unorm, Dimension::d2, {16, 12, 1}}, {}};
    image.texels.resize(byte_size(image.desc), std::byte{value});
    image::write_png(folder_ / name, image);
    return path(name);
  }
  nlohmann::ordered_json run_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    EXPECT_EQ(run(arguments), 0) << err_;
    return nlohmann::ordered_json::parse(out_);
  }
  /// One sentence that names what is wrong, the exit code, and no result.
  void expect_error(int code, const std::vector<std::string>& arguments, const std::string& sentence) {
    EXPECT_EQ(run(arguments), code) << join(arguments, " ");
    EXPECT_EQ(out_, "");
    EXPECT_THAT(err_, AllOf(HasSubstr("error: "), HasSubstr(sentence)));
  }
};

std::vector<std::string> keys_of(const nlohmann::ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

HostImage picture(double noise) {
  return image::test_picture(40, 30, 2, noise, 3);
}

TEST_F(CompareCommand, json_has_exactly_the_figures) {
  const std::string r = exr("r.exr", picture(0)), t = exr("t.exr", picture(0.2));
  const image::Metrics expected = image::compare(picture(0), picture(0.2));
  const nlohmann::ordered_json json = run_json({r, t});
  EXPECT_EQ(keys_of(json), kKeys);
  EXPECT_EQ(err_, "");
  EXPECT_DOUBLE_EQ(json["mse"], expected.mse);
  EXPECT_DOUBLE_EQ(json["relmse"], expected.relmse);
  EXPECT_DOUBLE_EQ(json["ssim"], expected.ssim);
  EXPECT_DOUBLE_EQ(json["flip"], expected.flip);
  EXPECT_EQ(json["fireflies"], expected.fireflies);
  EXPECT_EQ(json["non_finite"], 0);
}

TEST_F(CompareCommand, equal_images_have_an_infinite_psnr_which_json_does_not_know) {
  const std::string r = exr("r.exr", picture(0));
  const nlohmann::ordered_json json = run_json({r, r});
  EXPECT_TRUE(json["psnr"].is_null());
  EXPECT_EQ(json["ssim"], 1);
  EXPECT_EQ(json["flip"], 0);
  EXPECT_EQ(run({r, r}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("psnr        inf"), HasSubstr("R, reference"), HasSubstr("40x30")));
}

TEST_F(CompareCommand, options_reach_the_metrics) {
  const std::string r = exr("r.exr", picture(0)), t = exr("t.exr", picture(0.2));
  image::MetricOptions options;
  options.flip = image::FlipKind::ldr;
  options.pixels_per_degree = 30;
  options.epsilon = 0.5;
  options.firefly_factor = 1.5;
  const image::Metrics expected = image::compare(picture(0), picture(0.2), options);
  const nlohmann::ordered_json json =
      run_json({r, t, "--flip", "ldr", "--ppd", "30", "--epsilon", "0.5", "--firefly-factor", "1.5"});
  EXPECT_DOUBLE_EQ(json["flip"], expected.flip);
  EXPECT_DOUBLE_EQ(json["mape"], expected.mape);
  EXPECT_EQ(json["fireflies"], expected.fireflies);
  EXPECT_GT(expected.fireflies, 0u);
  EXPECT_THAT(err_, HasSubstr("clamped " + std::to_string(expected.clamped) + " pixels"));
  EXPECT_EQ(keys_of(run_json({r, t, "--only", "smape,mse"})), (std::vector<std::string>{"mse", "smape"}));
}

TEST_F(CompareCommand, eight_bits_are_made_linear_and_measured_as_display_values) {
  const std::string r = png("r.png", 188), t = png("t.png", 255);
  const double linear = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  nlohmann::ordered_json json = run_json({r, t});
  EXPECT_NEAR(json["bias"], 1 - linear, 1e-6);
  const auto grey = [](double v) { return image::constant_image(16, 12, {v, v, v}); };
  image::MetricOptions ldr;
  ldr.flip = image::FlipKind::ldr;
  EXPECT_NEAR(json["flip"], image::compare(grey(linear), grey(1), ldr).flip, 1e-5);
  EXPECT_NEAR(run_json({r, t, "--linear"})["bias"], 1 - 188 / 255.0, 1e-6);
  EXPECT_NEAR(run_json({r, t, "--flip", "hdr"})["flip"], image::compare(grey(linear), grey(1)).flip, 1e-5);
  EXPECT_EQ(run({r, t}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("sRGB transfer function removed"), HasSubstr("LDR")));
  EXPECT_EQ(run({r, exr("t.exr", grey(1))}), 0);
  EXPECT_THAT(err_, HasSubstr("one side has 8 or 16 bits"));
}

TEST_F(CompareCommand, a_part_can_be_compared) {
  const std::string r = exr("r.exr", image::constant_image(8, 8, {1, 1, 1}));
  const std::string t = exr("t.exr", image::color_image(8, 8, [](uint32_t x, uint32_t y) {
                              return x == 6 && y == 1 ? Rgb{3, 3, 3} : Rgb{1, 1, 1};
                            }));
  EXPECT_EQ(run_json({r, t, "--crop", "0,0,6x8"})["max_error"], 0);
  EXPECT_EQ(run_json({r, t, "--crop", "6,1,1x1"})["mse"], 4);
  expect_error(3, {r, t, "--crop", "6,1,3x1"}, "does not lie within");
  expect_error(2, {r, t, "--crop", "6,1"}, "option '--crop': expected X,Y,WIDTHxHEIGHT");
}

TEST_F(CompareCommand, maps_are_written) {
  const std::string r = exr("r.exr", picture(0)), t = exr("t.exr", picture(0.2));
  EXPECT_EQ(run({r, t, "--heat-map", path("new/heat.png"), "--error-map", path("error.exr"), "--only", "mse"}), 0)
      << err_;
  const HostImage heat = image::read_png(path("new/heat.png"));
  const HostImage expected = image::heat_map(image::flip_map(picture(0), picture(0.2)));
  EXPECT_EQ(heat.texels, expected.texels);
  const HostImage error = image::relative_error_map(picture(0), picture(0.2));
  EXPECT_EQ(image::read_exr(path("error.exr")).at(7, 9, "error"), error.at(7, 9, 0, 0));
  EXPECT_EQ(run({r, t, "--error-map", path("error.png"), "--only", "mse"}), 0) << err_;
  EXPECT_EQ(image::read_png(path("error.png")).texels, image::heat_map(error).texels);
  expect_error(2, {r, t, "--heat-map", path("heat.jpg")}, "expected a file name that ends in .png");
  expect_error(1, {r, t, "--heat-map", "/dev/null/heat.png"}, "/dev/null/heat.png");
}

class CompareSequences : public CompareCommand {
 protected:
  /// Frames of constant grey.
  void sequence(const std::string& folder, const std::vector<std::pair<int, double>>& frames) {
    for (const auto& [frame, value] : frames)
      exr(folder + "/radiance." + std::string(4 - std::to_string(frame).size(), '0') + std::to_string(frame) + ".exr",
          image::constant_image(12, 12, {value, value, value}));
  }
};

TEST_F(CompareSequences, run_folders_frame_by_frame) {
  sequence("r", {{3, 1}, {4, 1}, {5, 1}});
  sequence("t", {{3, 1}, {4, 3}, {5, 2}});
  const nlohmann::ordered_json json = run_json({path("r"), path("t")});
  std::vector<std::string> keys = kKeys;
  for (const char* key : {"flicker", "flicker_reference", "frame_difference", "frame_difference_reference", "frames"})
    keys.emplace_back(key);
  EXPECT_EQ(keys_of(json), keys);
  ASSERT_EQ(json["frames"].size(), 3u);
  EXPECT_EQ(json["frames"][1]["frame"], 4);
  EXPECT_EQ(json["frames"][1]["mse"], 4);
  EXPECT_TRUE(json["frames"][0]["psnr"].is_null());
  EXPECT_DOUBLE_EQ(json["mse"], 5.0 / 3);
  EXPECT_NEAR(json["flicker"], 1, 1e-9);
  EXPECT_EQ(json["flicker_reference"], 0);
  EXPECT_NEAR(json["frame_difference"], 1.5, 1e-9);
  EXPECT_EQ(run({path("r"), path("t")}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("\nmean "), HasSubstr("radiance.0005.exr"), HasSubstr("\nflicker ")));
}

TEST_F(CompareSequences, one_reference_serves_for_all_frames_and_patterns_name_frames) {
  const std::string r = exr("r.exr", image::constant_image(12, 12, {1, 1, 1}));
  sequence("t", {{0, 1}, {1, 2}});
  for (const char* pattern : {"t/radiance.%04d.exr", "t/radiance.####.exr", "t"}) {
    const nlohmann::ordered_json json = run_json({r, path(pattern)});
    EXPECT_EQ(json["frames"].size(), 2u);
    EXPECT_DOUBLE_EQ(json["mse"], 0.5);
  }
  EXPECT_EQ(run({r, path("t"), "--heat-map", path("h.####.png")}), 0) << err_;
  EXPECT_TRUE(std::filesystem::exists(path("h.0001.png")));
  expect_error(2, {r, path("t"), "--heat-map", path("h.png")}, "is one file for 2 frames");
  EXPECT_THAT(err_, HasSubstr("####"));
}

TEST_F(CompareSequences, missing_frames_are_named) {
  sequence("r", {{0, 1}, {2, 1}});
  sequence("t", {{0, 1}, {1, 1}, {2, 1}, {7, 1}});
  expect_error(3, {path("r"), path("t")}, "r' lacks frames 1, 7, which the other side has");
  expect_error(3, {path("t"), path("r")}, "r' lacks frames 1, 7, which the other side has");
  expect_error(3, {path("t"), path("r/radiance.0000.exr")}, "has 4 frames, and the test image is one file");
  expect_error(3, {path("r"), path("t"), "--output", "image"}, "has no frames of an output 'image'");
  EXPECT_THAT(err_, HasSubstr("there are: radiance"));
}

TEST_F(CompareSequences, frames_of_different_sizes_are_refused) {
  sequence("r", {{0, 1}, {1, 1}});
  sequence("t", {{0, 1}});
  exr("t/radiance.0001.exr", image::constant_image(12, 11, {1, 1, 1}));
  expect_error(3, {path("r"), path("t")}, "radiance.0001.exr': the images differ in size");
}

TEST_F(CompareCommand, what_cannot_be_compared_is_refused_in_one_sentence) {
  const std::string good = exr("good.exr", picture(0));
  const std::string small = exr("small.exr", image::constant_image(8, 6, {1, 1, 1}));
  std::ofstream(path("text.exr")) << "no image";
  image::write_npy(folder_ / "volume.npy", {{Format::r8_unorm, Dimension::d3, {2, 2, 2}}, std::vector<std::byte>(8)});
  expect_error(3, {good, path("none.exr")}, "none.exr' as an image: there is no such file");
  expect_error(3, {path("none.exr"), good}, "none.exr' as an image: there is no such file");
  expect_error(3, {path("text.exr"), good}, "text.exr' as an image");
  expect_error(3, {good, small}, "the reference has 40x30 pixels, the test image 8x6");
  expect_error(3, {path("volume.npy"), good}, "it is a volume");
  expect_error(3, {good, good, "--channel", "depth"}, "it has no channel or layer 'depth'");
  expect_error(2, {good, good, "--only", "mse,flop"}, "there is no metric 'flop'");
  EXPECT_THAT(err_, HasSubstr("did you mean 'flip'?"));
  expect_error(2, {good, good, "--ppd", "0"}, "'--ppd'");
  expect_error(2, {good}, "argument T is missing");
}

TEST_F(CompareCommand, a_black_reference_and_broken_pixels_have_defined_figures) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string black = exr("black.exr", image::constant_image(16, 16, {0, 0, 0}));
  const std::string white = exr("white.exr", image::constant_image(16, 16, {1, 1, 1}));
  const std::string broken = exr("broken.exr", image::color_image(16, 16, [nan](uint32_t x, uint32_t) {
                                   return x == 3 ? Rgb{nan, 0, 0} : Rgb{1, 1, 1};
                                 }));
  const nlohmann::ordered_json against_black = run_json({black, white});
  for (const auto& [key, value] : against_black.items()) EXPECT_TRUE(value.is_number()) << key;
  const nlohmann::ordered_json json = run_json({white, broken});
  EXPECT_EQ(json["non_finite"], 16);
  EXPECT_EQ(json["mse"], 0);
  EXPECT_EQ(run_json({broken, white})["non_finite"], 0);
  EXPECT_THAT(err_, HasSubstr("the reference has 16 pixels with a NaN"));
}

}  // namespace
}  // namespace lightloom::cli
