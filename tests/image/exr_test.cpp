#include "framework/image/exr.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "framework/base/error.hpp"
#include "tests/image/image_fixture.hpp"

namespace lightloom::image {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

struct Case {
  Format format;
  ChannelType type;
};

class ExrRoundTrip : public ::testing::TestWithParam<Case> {};

TEST_P(ExrRoundTrip, every_bit_survives) {
  const TemporaryFolder folder;
  const HostImage image = random_image(GetParam().format, Dimension::d2, {37, 19, 1}, 3);
  const std::vector<std::string> names = default_channel_names(image.desc, "radiance", "");
  write_exr(folder / "a.exr", image, names);
  const ExrImage back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.width, 37u);
  EXPECT_EQ(back.height, 19u);
  EXPECT_EQ(back.type, GetParam().type);
  EXPECT_EQ(back.channels, names);
  EXPECT_EQ(back.samples, image.texels);
  EXPECT_EQ(folder.file_count(), 1u);
}

INSTANTIATE_TEST_SUITE_P(
    Formats, ExrRoundTrip,
    ::testing::Values(Case{Format::r16_sfloat, ChannelType::half}, Case{Format::rg16_sfloat, ChannelType::half},
                      Case{Format::rgba16_sfloat, ChannelType::half}, Case{Format::r32_sfloat, ChannelType::float32},
                      Case{Format::d32_sfloat, ChannelType::float32}, Case{Format::rg32_sfloat, ChannelType::float32},
                      Case{Format::rgba32_sfloat, ChannelType::float32}, Case{Format::r32_uint, ChannelType::uint32},
                      Case{Format::rg32_uint, ChannelType::uint32}));

TEST(Exr, vector_channels_are_found_by_name_whatever_the_order_in_the_file) {
  const TemporaryFolder folder;
  const HostImage image = random_image(Format::rgba32_sfloat, Dimension::d2, {3, 2, 1}, 4);
  write_exr(folder / "a.exr", image, default_channel_names(image.desc, "surface", "position"));
  const ExrImage back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.at(2, 1, "X"), image.at(2, 1, 0, 0));
  EXPECT_EQ(back.at(2, 1, "Y"), image.at(2, 1, 0, 1));
  EXPECT_EQ(back.at(2, 1, "Z"), image.at(2, 1, 0, 2));
  EXPECT_EQ(back.at(2, 1, "W"), image.at(2, 1, 0, 3));
  EXPECT_THROW((void)back.at(2, 1, "R"), std::out_of_range);
  EXPECT_THROW((void)back.at(3, 1, "X"), std::out_of_range);
}

TEST(Exr, unorm8_goes_out_as_half_and_all_values_come_back) {
  const TemporaryFolder folder;
  HostImage image{{Format::r8_unorm, Dimension::d2, {256, 1, 1}}, std::vector<std::byte>(256)};
  for (size_t i = 0; i < 256; ++i) image.texels[i] = static_cast<std::byte>(i);
  write_exr(folder / "a.exr", image, {"distance"});
  const ExrImage back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.type, ChannelType::half);
  for (uint32_t i = 0; i < 256; ++i) EXPECT_EQ(std::lround(back.at(i, 0, "distance") * 255.0), i);
}

TEST(Exr, same_image_gives_same_file) {
  const TemporaryFolder folder;
  const HostImage image = random_image(Format::rgba16_sfloat, Dimension::d2, {64, 64, 1}, 5);
  write_exr(folder / "a.exr", image, {"R", "G", "B", "A"});
  write_exr(folder / "b.exr", image, {"R", "G", "B", "A"});
  EXPECT_EQ(read_bytes(folder / "a.exr"), read_bytes(folder / "b.exr"));
}

TEST(Exr, channel_names_follow_what_the_value_holds) {
  const ImageDesc four{Format::rgba16_sfloat, Dimension::d2, {1, 1, 1}};
  const ImageDesc two{Format::rg32_uint, Dimension::d2, {1, 1, 1}};
  const ImageDesc one{Format::r16_sfloat, Dimension::d2, {1, 1, 1}};
  EXPECT_THAT(default_channel_names(four, "radiance", ""), ElementsAre("R", "G", "B", "A"));
  EXPECT_THAT(default_channel_names(four, "surface", "geometric_normal"), ElementsAre("X", "Y", "Z", "W"));
  EXPECT_THAT(default_channel_names(two, "surface", "id"), ElementsAre("object", "material"));
  EXPECT_THAT(default_channel_names({Format::rgba32_uint, Dimension::d2, {1, 1, 1}}, "surface", "id"),
              ElementsAre("object", "material", "triangle", "weights"));
  EXPECT_THAT(default_channel_names(two, "offset", ""), ElementsAre("X", "Y"));
  EXPECT_THAT(default_channel_names(one, "variance", ""), ElementsAre("variance"));
}

TEST(Exr, a_volume_a_wrong_name_count_and_missing_texels_are_errors) {
  const TemporaryFolder folder;
  const HostImage volume = random_image(Format::r16_sfloat, Dimension::d3, {2, 2, 2}, 6);
  EXPECT_THROW(write_exr(folder / "a.exr", volume, {"v"}), Error);
  HostImage flat = random_image(Format::r16_sfloat, Dimension::d2, {2, 2, 1}, 6);
  EXPECT_THROW(write_exr(folder / "a.exr", flat, {"v", "w"}), Error);
  flat.texels.pop_back();
  EXPECT_THROW(write_exr(folder / "a.exr", flat, {"v"}), Error);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Exr, a_folder_that_is_not_there_is_one_clear_error) {
  const TemporaryFolder folder;
  const HostImage image = random_image(Format::r16_sfloat, Dimension::d2, {2, 2, 1}, 6);
  try {
    write_exr(folder / "missing/a.exr", image, {"v"});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_THAT(error.what(), HasSubstr("missing/a.exr"));
    EXPECT_THAT(error.hint(), HasSubstr("folder"));
  }
}

TEST(Exr, missing_and_broken_files_are_invalid_input) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", random_image(Format::rgba32_sfloat, Dimension::d2, {64, 64, 1}, 8), {"R", "G", "B", "A"});
  std::ofstream(folder / "text.exr") << "not an image";
  std::filesystem::copy_file(folder / "a.exr", folder / "cut.exr");
  std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "a.exr") / 2);
  expect_refused(folder, {"none.exr", "text.exr", "cut.exr", "."}, read_exr);
}

}  // namespace
}  // namespace lightloom::image
