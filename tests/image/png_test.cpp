#include "framework/image/png.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string_view>

#include "framework/base/error.hpp"
#include "tests/image/image_fixture.hpp"

namespace lightloom::image {
namespace {

TEST(Png, colours_survive_and_alpha_is_dropped) {
  const TemporaryFolder folder;
  const HostImage image = random_image(Format::rgba8_unorm, Dimension::d2, {33, 17, 1}, 1);
  write_png(folder / "a.png", image);
  const HostImage back = read_png(folder / "a.png");
  ASSERT_EQ(back.desc, image.desc);
  for (uint32_t y = 0; y < 17; ++y) {
    for (uint32_t x = 0; x < 33; ++x) {
      for (uint32_t c = 0; c < 3; ++c) ASSERT_EQ(back.at(x, y, 0, c), image.at(x, y, 0, c));
      ASSERT_EQ(back.at(x, y, 0, 3), 1.0);
    }
  }
  EXPECT_EQ(folder.file_count(), 1u);
}

// The header as the PNG specification lays it out: signature, IHDR length, "IHDR", width, height, depth, colour type.
TEST(Png, the_header_says_8_bit_rgb) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", random_image(Format::rgba8_unorm, Dimension::d2, {300, 2, 1}, 2));
  std::ifstream stream(folder / "a.png", std::ios::binary);
  std::string head(26, '\0');
  stream.read(head.data(), 26);
  EXPECT_EQ(head, std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x01\x2c\0\0\0\x02\x08\x02", 26));
}

// Files made by another encoder (Python's zlib and struct), in hexadecimal.
constexpr std::string_view kGrey10And200 =
    "89504e470d0a1a0a0000000d4948445200000002000000010800000000d14920560000000e494441547801010300fcff000ac800df00d33eb7"
    "1a2e0000000049454e44ae426082";
constexpr std::string_view kRgba200_100_50_128 =
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c48900000010494441547801010500faff00c8643280053501df"
    "21536c480000000049454e44ae426082";

std::string from_hexadecimal(std::string_view digits) {
  std::string bytes;
  for (size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

TEST(Png, grey_is_spread_and_alpha_is_not_multiplied_in) {
  const TemporaryFolder folder;
  std::ofstream(folder / "grey.png", std::ios::binary) << from_hexadecimal(kGrey10And200);
  std::ofstream(folder / "rgba.png", std::ios::binary) << from_hexadecimal(kRgba200_100_50_128);
  const HostImage grey = read_png(folder / "grey.png");
  ASSERT_EQ(grey.desc.extent, (Extent3{2, 1, 1}));
  for (uint32_t c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(grey.at(1, 0, 0, c) * 255, 200);
  EXPECT_EQ(grey.at(1, 0, 0, 3), 1.0);
  const HostImage rgba = read_png(folder / "rgba.png");
  EXPECT_EQ(rgba.texels, (std::vector<std::byte>{std::byte{200}, std::byte{100}, std::byte{50}, std::byte{128}}));
}

TEST(Png, other_formats_cannot_be_written) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "a.png", random_image(Format::rgba16_sfloat, Dimension::d2, {2, 2, 1}, 3)), Error);
  EXPECT_THROW(write_png(folder / "a.png", random_image(Format::rgba8_unorm, Dimension::d3, {2, 2, 2}, 3)), Error);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Png, missing_and_broken_files_are_invalid_input) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", random_image(Format::rgba8_unorm, Dimension::d2, {64, 64, 1}, 4));
  std::filesystem::copy_file(folder / "a.png", folder / "cut.png");
  std::filesystem::resize_file(folder / "cut.png", 4000);
  std::ofstream(folder / "text.png") << "not an image";
  expect_refused(folder, {"none.png", "cut.png", "text.png"}, read_png);
}

}  // namespace
}  // namespace lightloom::image
