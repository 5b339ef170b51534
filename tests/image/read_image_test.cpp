#include "framework/image/read_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/image/exr.hpp"
#include "framework/image/npy.hpp"
#include "framework/image/oiio_io.hpp"
#include "framework/image/png.hpp"
#include "tests/image/image_fixture.hpp"
#include "tests/image/metric_images.hpp"

namespace lightloom::image {
namespace {

using ::testing::HasSubstr;

template <typename T>
void write(const std::filesystem::path& file, const std::string& format, OIIO::TypeDesc type,
           const std::vector<std::string>& channels, const std::vector<T>& samples, uint32_t width = 2) {
  const auto height = samples.size() / channels.size() / width;
  OIIO::ImageSpec spec(int(width), int(height), int(channels.size()), type);
  spec.channelnames = channels;
  encode_and_write(file, format, spec, samples.data());
}

double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

TEST(ReadImage, eight_and_sixteen_bits_are_made_linear) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> bytes = {0, 10, 11, 128, 200, 255};
  write(folder / "a.png", "png", OIIO::TypeDesc::UINT8, {"R", "G", "B"}, bytes);
  const ReadImage read = read_image(folder / "a.png");
  EXPECT_TRUE(read.display && read.decoded);
  ASSERT_EQ(read.image.desc.extent, (Extent3{2, 1, 1}));
  for (uint32_t k = 0; k < 6; ++k)
    EXPECT_NEAR(read.image.at(k / 3, 0, 0, k % 3), srgb_to_linear(bytes[k] / 255.0), 1e-6);
  EXPECT_EQ(read.image.at(0, 0, 0, 3), 1);
  ReadOptions as_it_is;
  as_it_is.linear = true;
  const ReadImage raw = read_image(folder / "a.png", as_it_is);
  EXPECT_TRUE(raw.display && !raw.decoded);
  for (uint32_t k = 0; k < 6; ++k) EXPECT_NEAR(raw.image.at(k / 3, 0, 0, k % 3), bytes[k] / 255.0, 1e-7);

  const std::vector<uint16_t> words = {0, 655, 40000, 65535, 1, 2};
  write(folder / "b.png", "png", OIIO::TypeDesc::UINT16, {"R", "G", "B"}, words);
  const ReadImage wide = read_image(folder / "b.png");
  EXPECT_TRUE(wide.display && wide.decoded);
  for (uint32_t k = 0; k < 6; ++k)
    EXPECT_NEAR(wide.image.at(k / 3, 0, 0, k % 3), srgb_to_linear(words[k] / 65535.0), 1e-6);
}

TEST(ReadImage, a_file_that_says_that_it_is_linear_is_believed) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "Linear");
  const std::vector<uint8_t> bytes = {51, 102, 153};
  encode_and_write(folder / "a.png", "png", spec, bytes.data());
  const ReadImage read = read_image(folder / "a.png");
  EXPECT_TRUE(read.display && !read.decoded);
  EXPECT_NEAR(read.image.at(0, 0, 0, 1), 0.4, 1e-6);
}

TEST(ReadImage, many_formats) {
  const TemporaryFolder folder;
  const std::vector<float> floats = {0.25f, 0.5f, 2, 64, 0, 1};
  for (const auto& [file, format] : {std::pair("a.exr", "openexr"), {"a.tif", "tiff"}, {"a.hdr", "hdr"}}) {
    write(folder / file, format, OIIO::TypeDesc::FLOAT, {"R", "G", "B"}, floats);
    const ReadImage read = read_image(folder / file);
    EXPECT_FALSE(read.display || read.decoded) << file;
    for (uint32_t k = 0; k < 6; ++k) EXPECT_NEAR(read.image.at(k / 3, 0, 0, k % 3), double(floats[k]), 0.26) << file;
  }
  const std::vector<uint8_t> grey(64 * 3, 188);
  for (const auto& [file, format] : {std::pair("a.jpg", "jpeg"), {"a.bmp", "bmp"}, {"b.tif", "tiff"}}) {
    write(folder / file, format, OIIO::TypeDesc::UINT8, {"R", "G", "B"}, grey, 8);
    EXPECT_NEAR(read_image(folder / file).image.at(3, 3, 0, 1), srgb_to_linear(188 / 255.0), 0.01) << file;
  }
}

TEST(ReadImage, one_channel_is_grey_and_alpha_is_left_out) {
  const TemporaryFolder folder;
  write(folder / "grey.png", "png", OIIO::TypeDesc::UINT8, {"Y"}, std::vector<uint8_t>{0, 255});
  EXPECT_EQ(read_image(folder / "grey.png").image.desc.format, Format::r32_sfloat);
  write(folder / "alpha.png", "png", OIIO::TypeDesc::UINT8, {"Y", "A"}, std::vector<uint8_t>{255, 51, 0, 0});
  const HostImage grey = read_image(folder / "alpha.png").image;
  EXPECT_EQ(grey.desc.format, Format::r32_sfloat);
  EXPECT_NEAR(grey.at(0, 0, 0, 0), 1, 1e-6) << "alpha is not multiplied in";
  write(folder / "rgba.png", "png", OIIO::TypeDesc::UINT8, {"R", "G", "B", "A"},
        std::vector<uint8_t>{255, 0, 255, 51, 0, 0, 0, 0});
  EXPECT_NEAR(read_image(folder / "rgba.png").image.at(0, 0, 0, 2), 1, 1e-6);
}

TEST(ReadImage, channels_and_layers_are_chosen_by_name) {
  const TemporaryFolder folder;
  write(folder / "a.exr", "openexr", OIIO::TypeDesc::FLOAT,
        {"B", "G", "R", "diffuse.R", "diffuse.G", "diffuse.B", "depth"}, std::vector<float>{3, 2, 1, 4, 5, 6, 7}, 1);
  const auto values = [&](const std::string& channel) {
    ReadOptions options;
    options.channel = channel;
    const HostImage image = read_image(folder / "a.exr", options).image;
    std::vector<double> result;
    for (uint32_t c = 0; c < std::min(3u, format_info(image.desc.format).channels); ++c)
      result.push_back(image.at(0, 0, 0, c));
    return result;
  };
  EXPECT_EQ(values(""), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(values("diffuse"), (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(values("depth"), (std::vector<double>{7}));
  EXPECT_EQ(values("diffuse.G"), (std::vector<double>{5}));
  try {
    (void)values("difuse");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("it has no channel or layer 'difuse'"));
    EXPECT_EQ(error.hint(), "did you mean 'diffuse'?");
  }
  write(folder / "b.exr", "openexr", OIIO::TypeDesc::FLOAT, {"u", "v"}, std::vector<float>{1, 2}, 1);
  try {
    (void)read_image(folder / "b.exr");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("which of its channels"));
    EXPECT_THAT(error.hint(), HasSubstr("u, v"));
  }
}

TEST(ReadImage, dumps) {
  const TemporaryFolder folder;
  const HostImage image = test_picture(5, 4, 3, 0, 1);
  write_npy(folder / "a.npy", image);
  const ReadImage read = read_image(folder / "a.npy");
  EXPECT_EQ(read.image.texels, image.texels);
  EXPECT_FALSE(read.display || read.decoded);
  write_npy(folder / "b.npy", random_image(Format::rgba8_unorm, Dimension::d2, {5, 4, 1}, 1));
  EXPECT_TRUE(read_image(folder / "b.npy").display);
  EXPECT_FALSE(read_image(folder / "b.npy").decoded);
  write_exr(folder / "normal.exr", image, {"X", "Y", "Z", "W"});
  EXPECT_NEAR(read_image(folder / "normal.exr").image.at(3, 2, 0, 1), image.at(3, 2, 0, 1), 1e-6);
}

TEST(ReadImage, what_is_no_image_is_refused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text.png") << "not an image";
  std::ofstream(folder / "text.txt") << "not an image";
  std::ofstream(folder / "empty.exr");
  write_png(folder / "whole.png", random_image(Format::rgba8_unorm, Dimension::d2, {64, 64, 1}, 4));
  std::filesystem::copy_file(folder / "whole.png", folder / "cut.png");
  std::filesystem::resize_file(folder / "cut.png", 4000);
  write_exr(folder / "id.exr", random_image(Format::rgba32_uint, Dimension::d2, {4, 4, 1}, 1), {"R", "G", "B", "A"});
  std::filesystem::create_directory(folder / "folder");
  expect_refused(folder, {"none.png", "text.png", "text.txt", "empty.exr", "cut.png", "id.exr", "folder", "none.npy"},
                 [](const std::filesystem::path& file) { return read_image(file); });
}

}  // namespace
}  // namespace lightloom::image
