#include "framework/image/dumped_image.hpp"

#include <cmath>
#include <limits>

#include "framework/image/bit_difference.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/npy.hpp"
#include "tests/image/image_fixture.hpp"

namespace lightloom::image {
namespace {

constexpr std::initializer_list<Format> kFormats = {
    Format::r8_unorm,   Format::rgba8_unorm,   Format::rgba16_unorm, Format::r16_sfloat,    Format::rg16_sfloat,
    Format::r32_sfloat, Format::rgba16_sfloat, Format::rg32_sfloat,  Format::rgba32_sfloat, Format::r32_uint,
    Format::rg32_uint,  Format::rgba32_uint,   Format::d32_sfloat};

/// NaNs of any payload, denormals and negative zeros among them.
TEST(DumpedImage, EveryFormatComesBackBitForBitFromBothKindsOfFile) {
  const TemporaryFolder folder;
  for (const Format format : kFormats) {
    for (const char* port : {"radiance", "id", "position"}) {
      const HostImage image = random_image(format, Dimension::d2, {33, 31, 1}, 11);
      const std::vector<std::string> names = default_channel_names(image.desc, port, "");
      write_exr(folder / "a.exr", image, names);
      write_npy(folder / "a.npy", image);
      for (const char* file : {"a.exr", "a.npy"}) {
        const HostImage back = read_dumped(folder / file, image.desc, names);
        EXPECT_EQ(back.desc, image.desc);
        EXPECT_EQ(back.texels, image.texels) << format_info(format).name << " of a port '" << port << "' in " << file;
      }
    }
    const HostImage volume = random_image(format, Dimension::d3, {7, 5, 3}, 12);
    write_npy(folder / "v.npy", volume);
    EXPECT_EQ(read_dumped(folder / "v.npy", volume.desc, {}).texels, volume.texels) << format_info(format).name;
  }
}

TEST(DumpedImage, AllHalvesAndAllBytesSurviveExr) {
  const TemporaryFolder folder;
  HostImage halves{{Format::r16_sfloat, Dimension::d2, {256, 256, 1}}, {}};
  for (uint32_t bits = 0; bits < 65536; ++bits) {
    halves.texels.push_back(static_cast<std::byte>(bits & 0xFFu));
    halves.texels.push_back(static_cast<std::byte>(bits >> 8));
  }
  HostImage bytes{{Format::r8_unorm, Dimension::d2, {256, 1, 1}}, {}};
  for (uint32_t byte = 0; byte < 256; ++byte) bytes.texels.push_back(static_cast<std::byte>(byte));
  for (const HostImage& image : {halves, bytes}) {
    write_exr(folder / "a.exr", image, {"a"});
    EXPECT_EQ(read_dumped(folder / "a.exr", image.desc, {"a"}).texels, image.texels);
  }
}

TEST(DumpedImage, RefusesWhatIsNotTheValue) {
  const TemporaryFolder folder;
  const HostImage image = random_image(Format::rgba16_sfloat, Dimension::d2, {4, 3, 1}, 1);
  const std::vector<std::string> names = {"R", "G", "B", "A"};
  write_exr(folder / "a.exr", image, names);
  write_npy(folder / "a.npy", image);
  ImageDesc larger = image.desc;
  larger.extent.width = 5;
  ImageDesc wider = image.desc;
  wider.format = Format::rgba32_sfloat;
  ImageDesc fewer = image.desc;
  fewer.format = Format::rg16_sfloat;
  for (const ImageDesc& desc : {larger, wider, fewer}) {
    const auto read = [&](const std::filesystem::path& file) {
      return read_dumped(file, desc, default_channel_names(desc, "radiance", ""));
    };
    expect_refused(folder, {"a.exr", "a.npy", "missing.exr", "missing.npy"}, read);
  }
  expect_refused(folder, {"a.exr"}, [&](const std::filesystem::path& file) {
    return read_dumped(file, image.desc, {"X", "Y", "Z", "W"});
  });
}

HostImage row(std::vector<float> numbers) {
  HostImage image{{Format::r32_sfloat, Dimension::d2, {static_cast<uint32_t>(numbers.size()), 1, 1}}, {}};
  image.texels.resize(numbers.size() * sizeof(float));
  std::memcpy(image.texels.data(), numbers.data(), image.texels.size());
  return image;
}

TEST(BitDifference, CountsTexelsAndFindsTheLargest) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(bit_difference(row({1, nan, 3}), row({1, nan, 3})).texels, 0U);
  const BitDifference plain = bit_difference(row({1, 2, 3, 4}), row({1, 2.5f, 0, 4}));
  EXPECT_EQ(plain.texels, 2U);
  EXPECT_EQ(plain.place[0], 2U);
  EXPECT_EQ(plain.one, 3);
  EXPECT_EQ(plain.other, 0);
  const BitDifference broken = bit_difference(row({1e30f, nan, 3}), row({-1e30f, 2, 3}));
  EXPECT_EQ(broken.texels, 2U);
  EXPECT_EQ(broken.place[0], 1U) << "a number against NaN is the worst";
  EXPECT_EQ(bit_difference(row({0, infinity, 1}), row({0, -infinity, 2})).place[0], 1U);
  EXPECT_EQ(bit_difference(row({0.0f}), row({-0.0f})).texels, 1U) << "equal numbers of different bits";
  EXPECT_THROW(static_cast<void>(bit_difference(row({0}), row({0, 1}))), std::invalid_argument);
}

TEST(BitDifference, OfAVolumeNamesSliceAndChannel) {
  const HostImage one = random_image(Format::rgba8_unorm, Dimension::d3, {5, 4, 3}, 2);
  HostImage other = one;
  const size_t texel = (2 * 4 + 1) * 5 + 3;
  other.texels[texel * 4 + 2] ^= std::byte{0x80};
  const BitDifference difference = bit_difference(one, other);
  EXPECT_EQ(difference.texels, 1U);
  EXPECT_EQ(difference.place, (std::array<uint32_t, 3>{3, 1, 2}));
  EXPECT_EQ(difference.channel, 2U);
}

}  // namespace
}  // namespace lightloom::image
