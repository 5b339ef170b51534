#include "framework/image/host_image.hpp"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "framework/image/half.hpp"
#include "tests/image/image_fixture.hpp"

namespace lightloom::image {
namespace {

// The oracle is Imath's table-driven half.
TEST(Half, every_bit_pattern_decodes_as_imath_does) {
  for (uint32_t bits = 0; bits < 65536; ++bits) {
    Imath::half reference;
    reference.setBits(static_cast<uint16_t>(bits));
    const auto expected = static_cast<float>(reference);
    const float actual = float_from_half(static_cast<uint16_t>(bits));
    if (std::isnan(expected)) {
      ASSERT_TRUE(std::isnan(actual)) << bits;
    } else {
      ASSERT_EQ(std::bit_cast<uint32_t>(expected), std::bit_cast<uint32_t>(actual)) << bits;
    }
  }
}

TEST(Half, encoding_rounds_as_imath_does) {
  std::mt19937 generator(7);
  const auto check = [](float value) {
    ASSERT_EQ(Imath::half(value).bits(), half_from_float(value)) << std::hexfloat << value;
  };
  for (int i = 0; i < 200000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<uint32_t>(generator()));
    if (!std::isnan(value)) check(value);
  }
  // Midpoints between neighbouring halves and the floats beside them.
  for (uint32_t bits = 0; bits < 0x7BFF; ++bits) {
    const float low = float_from_half(static_cast<uint16_t>(bits));
    const float middle = 0.5f * (low + float_from_half(static_cast<uint16_t>(bits + 1)));
    check(middle);
    check(std::nextafter(middle, 0.0f));
    check(std::nextafter(middle, std::numeric_limits<float>::max()));
  }
  for (const float value : {65504.0f, 65519.996f, 65520.0f, 1e9f}) check(value);
  EXPECT_TRUE(std::isnan(float_from_half(half_from_float(std::numeric_limits<float>::quiet_NaN()))));
}

TEST(HostImage, at_decodes_each_kind_of_channel) {
  HostImage bytes{{Format::rgba8_unorm, Dimension::d2, {2, 1, 1}}, std::vector<std::byte>(8)};
  bytes.texels[5] = std::byte{51};
  EXPECT_DOUBLE_EQ(bytes.at(1, 0, 0, 1), 0.2);
  HostImage halves{{Format::rg16_sfloat, Dimension::d2, {1, 1, 1}}, std::vector<std::byte>(4)};
  const uint16_t minus_two = 0xC000;
  std::memcpy(halves.texels.data() + 2, &minus_two, 2);
  EXPECT_EQ(halves.at(0, 0, 0, 1), -2.0);
  HostImage ids{{Format::rg32_uint, Dimension::d2, {1, 1, 1}}, std::vector<std::byte>(8, std::byte{0xFF})};
  EXPECT_EQ(ids.at(0, 0, 0, 0), 4294967295.0);
}

TEST(HostImage, x_runs_fastest_then_y_then_z) {
  HostImage image{{Format::r32_sfloat, Dimension::d3, {3, 4, 5}}, std::vector<std::byte>(3 * 4 * 5 * 4)};
  float count = 0;
  for (size_t i = 0; i < 60; ++i, ++count) std::memcpy(image.texels.data() + i * 4, &count, 4);
  EXPECT_EQ(image.at(1, 0, 0, 0), 1);
  EXPECT_EQ(image.at(0, 1, 0, 0), 3);
  EXPECT_EQ(image.at(0, 0, 1, 0), 12);
  EXPECT_EQ(image.at(2, 3, 4, 0), 59);
}

TEST(HostImage, at_outside_the_image_throws) {
  const HostImage image = random_image(Format::rgba8_unorm, Dimension::d2, {2, 3, 1}, 1);
  EXPECT_THROW((void)image.at(2, 0, 0, 0), std::out_of_range);
  EXPECT_THROW((void)image.at(0, 3, 0, 0), std::out_of_range);
  EXPECT_THROW((void)image.at(0, 0, 1, 0), std::out_of_range);
  EXPECT_THROW((void)image.at(0, 0, 0, 4), std::out_of_range);
  HostImage cut = image;
  cut.texels.resize(10);
  EXPECT_THROW((void)cut.at(1, 2, 0, 3), std::out_of_range);
}

}  // namespace
}  // namespace lightloom::image
