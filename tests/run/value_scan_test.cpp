// What scans find on the device, against a search on the host through images of random bits, in every format.
#include "framework/run/value_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "framework/image/host_image.hpp"
#include "framework/run/slabs.hpp"
#include "tests/run/observed_run.hpp"

namespace lightloom::run {
namespace {

class ValueScanTest : public test::DeviceTest {};

TEST(Slabs, CoverAnImageInOrderWithinTheirBytes) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const auto up_to = [&](uint32_t most) { return 1 + static_cast<uint32_t>(random() % most); };
    const bool volume = trial % 2 == 0;
    const ImageDesc desc{
        Format::rg16_sfloat, volume ? Dimension::d3 : Dimension::d2, {up_to(40), up_to(30), volume ? up_to(20) : 1}};
    const uint64_t most = up_to(5000);
    uint32_t next = 0;
    for (const Slab& slab : slabs_of(desc, most)) {
      const auto& [width, height, depth] = slab.extent;
      EXPECT_EQ(slab.first_texel, next);
      EXPECT_EQ(slab.offset.width, 0U);
      EXPECT_EQ((slab.offset.depth * desc.extent.height + slab.offset.height) * desc.extent.width, next);
      EXPECT_EQ(width, desc.extent.width);
      EXPECT_EQ(width * height * depth, slab.texels);
      EXPECT_TRUE(depth == 1 || height == desc.extent.height) << "several slices must be whole";
      EXPECT_LE(slab.offset.height + height, desc.extent.height);
      EXPECT_TRUE(uint64_t{slab.texels} * 4 <= most || (height == 1 && depth == 1));
      EXPECT_LE(uint64_t{slab.texels} * 4, largest_slab_bytes(desc, most));
      next += slab.texels;
    }
    EXPECT_EQ(next, desc.extent.width * desc.extent.height * desc.extent.depth);
  }
}

/// A host pass that writes the same bits in every frame.
PassType bits_type(const std::string& name, const ImageDesc& desc, const std::vector<std::byte>& bits) {
  PassType type;
  type.name = name;
  type.doc = "For tests.";
  Port port = toy::image_port("image", Direction::out);
  port.parts = {{"", desc.format, ""}};
  port.access = Access::transfer_write;
  port.dimension = desc.dimension;
  port.extent = ExtentRule::fixed;
  port.fixed_extent = desc.extent;
  type.ports = {port};
  type.reads = FrameState::seed;
  type.host = [bits](HostContext& context) {
    const HostOutput output = context.output("image", "");
    std::memcpy(output.texels.data(), bits.data(), bits.size());
  };
  return type;
}

std::string graph_of(const std::string& type) {
  return R"({ "lightloom": 1, "name": "bits", "view": { "width": 4, "height": 4 },
    "trace": { "width": 4, "height": 4 }, "passes": { "bits": { "type": ")" +
         type + R"(" } }, "outputs": { "image": "bits.image" } })";
}

/// Mostly ordinary numbers, some special; or all of them special.
std::vector<std::byte> random_bits(const ImageDesc& desc, std::mt19937& random, uint32_t one_special_in) {
  const image::ChannelType type = image::channel_type(desc.format);
  const size_t bytes = image::channel_bytes(type);
  std::vector<std::byte> texels(byte_size(desc));
  for (size_t at = 0; at < texels.size(); at += bytes) {
    uint32_t bits = static_cast<uint32_t>(random()) & 0x3fffffffu;
    if (desc.format == Format::d32_sfloat)
      bits = 0x3f000000u | (bits & 0x7fffffu);
    else if (type == image::ChannelType::half)
      bits &= 0x3fffu;
    if (one_special_in > 0 && random() % one_special_in == 0 && desc.format != Format::d32_sfloat) {
      const uint32_t sign = static_cast<uint32_t>(random() % 2);
      const uint32_t payload = random() % 2 == 0 ? 0 : static_cast<uint32_t>(random());
      bits = type == image::ChannelType::half ? (sign << 15 | 0x7c00u | (payload & 0x3ffu))
                                              : (sign << 31 | 0x7f800000u | (payload & 0x7fffffu));
    }
    std::memcpy(texels.data() + at, &bits, bytes);
  }
  return texels;
}

struct Expected {
  uint32_t nan = 0;
  uint32_t infinite = 0;
  std::optional<uint32_t> first;
};

Expected search_on_host(const image::HostImage& image) {
  Expected expected;
  const Extent3& extent = image.desc.extent;
  uint32_t number = 0;
  for (uint32_t z = 0; z < extent.depth; ++z)
    for (uint32_t y = 0; y < extent.height; ++y)
      for (uint32_t x = 0; x < extent.width; ++x, ++number) {
        bool nan = false;
        bool infinite = false;
        for (uint32_t channel = 0; channel < format_info(image.desc.format).channels; ++channel) {
          nan = nan || std::isnan(image.at(x, y, z, channel));
          infinite = infinite || std::isinf(image.at(x, y, z, channel));
        }
        expected.nan += nan ? 1 : 0;
        expected.infinite += infinite ? 1 : 0;
        if ((nan || infinite) && !expected.first) expected.first = number;
      }
  return expected;
}

void expect_found(const ImageDesc& desc, const std::vector<std::byte>& bits) {
  const scene::Scene quad = toy::one_quad();
  const toy::ObservedGraph graph(graph_of("test_bits"), {bits_type("test_bits", desc, bits)}, quad);
  const FrameResult result = toy::run_frames(graph.plan, quad, 1, toy::observed_options()).front();
  const image::HostImage& image = result.outputs.front().image;
  ASSERT_TRUE(image.texels == bits) << "the image does not hold the bits that the test gave it";
  const Expected expected = search_on_host(image);
  ASSERT_EQ(result.scanned.size(), 1U);
  const ScannedValue& seen = result.scanned.front();
  EXPECT_EQ(seen.nan_texels, expected.nan);
  EXPECT_EQ(seen.infinite_texels, expected.infinite);
  EXPECT_EQ(seen.first_bad, expected.first);
  if (!expected.first) return;
  const size_t bytes = image::channel_bytes(image::channel_type(desc.format));
  for (uint32_t channel = 0; channel < format_info(desc.format).channels; ++channel) {
    uint32_t raw = 0;
    std::memcpy(&raw, bits.data() + (*expected.first * format_info(desc.format).channels + channel) * bytes, bytes);
    EXPECT_EQ(seen.texel[channel], raw) << channel;
  }
}

TEST_F(ValueScanTest, EveryFormatAndDimensionIsSearchedBitForBit) {
  std::mt19937 random(11);
  for (const Format format : {Format::r8_unorm, Format::rgba8_unorm, Format::r16_sfloat, Format::rg16_sfloat,
                              Format::rgba16_sfloat, Format::r32_sfloat, Format::rg32_sfloat, Format::rgba32_sfloat,
                              Format::r32_uint, Format::rg32_uint, Format::rgba32_uint, Format::d32_sfloat})
    for (const Dimension dimension : {Dimension::d2, Dimension::d3}) {
      if (format_info(format).depth && dimension == Dimension::d3) continue;
      const ImageDesc desc{format, dimension, {13, 7, dimension == Dimension::d3 ? 5U : 1U}};
      SCOPED_TRACE(to_string(desc));
      for (const uint32_t one_special_in : {0U, 1U, 40U}) expect_found(desc, random_bits(desc, random, one_special_in));
    }
}

TEST_F(ValueScanTest, AnImageOfSeveralPiecesIsSearchedThroughout) {
  std::mt19937 random(3);
  // 18 MB and 24 MB, in pieces of 4 MiB; a special number in few texels, and none before the last of them.
  for (const ImageDesc& desc : {ImageDesc{Format::rgba32_sfloat, Dimension::d2, {1009, 1117, 1}},
                                ImageDesc{Format::r32_sfloat, Dimension::d3, {211, 173, 167}}}) {
    SCOPED_TRACE(to_string(desc));
    std::vector<std::byte> bits = random_bits(desc, random, 0);
    const uint32_t nan = 0x7f801234u;
    for (const size_t from_end : {4U, 40'000U, 4'400'000U})
      std::memcpy(bits.data() + bits.size() - from_end, &nan, sizeof(nan));
    expect_found(desc, bits);
  }
}

TEST_F(ValueScanTest, WhatRunsOnceIsScannedInItsFrameAlone) {
  const scene::Scene quad = toy::one_quad();
  const ImageDesc desc{Format::r32_sfloat, Dimension::d2, {5, 3, 1}};
  std::mt19937 random(1);
  PassType type = bits_type("test_bits", desc, random_bits(desc, random, 3));
  type.reads = FrameState::none;
  const toy::ObservedGraph graph(graph_of("test_bits"), {type}, quad);
  ASSERT_EQ(graph.plan.once.size(), 1U);
  const std::vector<FrameResult> results = toy::run_frames(graph.plan, quad, 3, toy::observed_options());
  EXPECT_EQ(results[0].scanned.size(), 1U);
  EXPECT_TRUE(results[1].scanned.empty());
  EXPECT_TRUE(results[2].scanned.empty());
}

}  // namespace
}  // namespace lightloom::run
