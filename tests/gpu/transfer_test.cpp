#include "framework/gpu/transfer.hpp"

#include <algorithm>

#include "framework/gpu/format.hpp"
#include "tests/gpu/gpu_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

using test::error_of;
using ::testing::HasSubstr;

std::vector<std::byte> noise(size_t size, uint32_t seed) {
  std::mt19937 generator(seed);
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(generator() & 0xFF);
  return bytes;
}

/// Depth values are kept within [0, 1], the range of a depth image.
std::vector<std::byte> texels_for(Format format, size_t texels, uint32_t seed) {
  if (!format_info(format).depth) return noise(texels * format_info(format).bytes_per_texel, seed);
  std::vector<float> depths(texels);
  for (size_t i = 0; i < texels; ++i) depths[i] = static_cast<float>(i + seed) / static_cast<float>(texels + seed);
  std::vector<std::byte> bytes(texels * sizeof(float));
  std::memcpy(bytes.data(), depths.data(), bytes.size());
  return bytes;
}

class FormatRoundTrip : public test::DeviceTest, public ::testing::WithParamInterface<Format> {};

TEST_P(FormatRoundTrip, IsBitExact) {
  const Format format = GetParam();
  const FormatInfo& expected = format_info(format);
  EXPECT_EQ(texel_bytes(vulkan_format(format)), expected.bytes_per_texel);
  EXPECT_EQ(numeric_class(vulkan_format(format)), expected.numeric);
  const Image image(device(), {.format = vulkan_format(format),
                               .extent = {13, 7, 1},
                               .layers = 3,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                               .name = "round trip"});
  std::vector<std::vector<std::byte>> layers;
  std::vector<SubimageData> subimages;
  for (uint32_t layer = 0; layer < 3; ++layer) layers.push_back(texels_for(format, 13 * 7, layer));
  for (uint32_t layer = 0; layer < 3; ++layer) subimages.push_back({.layer = layer, .texels = layers[layer]});
  upload_image(device(), image, subimages);
  for (uint32_t layer = 0; layer < 3; ++layer) {
    EXPECT_EQ(read_image(device(), image, whole_level(image, layer)), layers[layer]) << "layer " << layer;
  }
}

INSTANTIATE_TEST_SUITE_P(AllFormats, FormatRoundTrip,
                         ::testing::Values(Format::r8_unorm, Format::rgba8_unorm, Format::r16_sfloat,
                                           Format::rg16_sfloat, Format::rgba16_sfloat, Format::r32_sfloat,
                                           Format::rg32_sfloat, Format::rgba32_sfloat, Format::r32_uint,
                                           Format::rg32_uint, Format::d32_sfloat),
                         [](const auto& row) { return std::string(format_info(row.param).name); });

using TransferTest = test::DeviceTest;
constexpr VkImageUsageFlags kUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

TEST_F(TransferTest, VolumeKeepsItsTexelsAndGivesABox) {
  const Image image(device(), {.format = VK_FORMAT_R32_UINT,
                               .dimension = Dimension::d3,
                               .extent = {5, 4, 3},
                               .usage = kUsage,
                               .name = "volume"});
  std::vector<uint32_t> texels(5 * 4 * 3);
  for (uint32_t i = 0; i < texels.size(); ++i) texels[i] = i * 2654435761u;
  const SubimageData data{.texels = std::as_bytes(std::span(texels))};
  upload_image(device(), image, std::span(&data, 1));
  EXPECT_EQ(test::values_of<uint32_t>(read_image(device(), image, whole_level(image))), texels);

  const ImageRegion box{.offset = {1, 2, 1}, .extent = {3, 2, 2}};
  std::vector<uint32_t> expected;
  for (uint32_t z = 1; z < 3; ++z) {
    for (uint32_t y = 2; y < 4; ++y) {
      for (uint32_t x = 1; x < 4; ++x) expected.push_back(texels[x + 5 * (y + 4 * z)]);
    }
  }
  EXPECT_EQ(test::values_of<uint32_t>(read_image(device(), image, box)), expected);
}

TEST_F(TransferTest, MipChainOfOddSizeKeepsEachLevel) {
  const Image image(device(), {.format = VK_FORMAT_R8G8B8A8_SRGB,
                               .extent = {9, 5, 1},
                               .layers = 2,
                               .mip_levels = 4,
                               .usage = kUsage,
                               .name = "page"});
  std::vector<std::vector<std::byte>> storage;
  std::vector<SubimageData> subimages;
  for (uint32_t layer = 0; layer < 2; ++layer) {
    for (uint32_t level = 0; level < 4; ++level) {
      const Extent3 extent = mip_extent(image.spec().extent, level);
      storage.push_back(noise(extent.width * extent.height * 4, layer * 10 + level));
    }
  }
  for (uint32_t i = 0; i < 8; ++i) subimages.push_back({.layer = i / 4, .mip_level = i % 4, .texels = storage[i]});
  upload_image(device(), image, subimages);
  for (uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(read_image(device(), image, whole_level(image, i / 4, i % 4)), storage[i]) << "subimage " << i;
  }
}

TEST_F(TransferTest, MipExtentHalvesDownToOne) {
  EXPECT_EQ(mip_extent({9, 5, 1}, 1), (Extent3{4, 2, 1}));
  EXPECT_EQ(mip_extent({9, 5, 1}, 3), (Extent3{1, 1, 1}));
}

TEST_F(TransferTest, UploadOfWrongSizeSaysHowManyBytesItExpects) {
  const Image image(device(), {.format = VK_FORMAT_R32_UINT, .extent = {4, 4, 1}, .usage = kUsage, .name = "small"});
  const std::vector<std::byte> texels(63);
  const SubimageData data{.texels = texels};
  EXPECT_STREQ(error_of([&] { upload_image(device(), image, std::span(&data, 1)); }).what(),
               "upload to image 'small', layer 0, mip level 0 has 63 bytes instead of 64");
}

TEST_F(TransferTest, BuffersOfEveryKindKeepTheirBytes) {
  const std::vector<std::byte> bytes = noise(1000, 1);
  for (MemoryKind kind : {MemoryKind::device, MemoryKind::upload, MemoryKind::readback}) {
    const Buffer buffer(device(), bytes.size(), 0, kind, "bytes");
    EXPECT_EQ(buffer.mapped().empty(), kind == MemoryKind::device);
    upload_buffer(device(), buffer, bytes);
    EXPECT_EQ(read_buffer(device(), buffer), bytes);
  }
}

TEST_F(TransferTest, UploadAtAnOffsetLeavesTheRest) {
  const Buffer buffer(device(), 16, 0, MemoryKind::device, "bytes");
  const std::vector<std::byte> zeros(16);
  const std::vector<std::byte> ones(4, std::byte{1});
  upload_buffer(device(), buffer, zeros);
  upload_buffer(device(), buffer, ones, 8);
  std::vector<std::byte> expected = zeros;
  std::fill(expected.begin() + 8, expected.begin() + 12, std::byte{1});
  EXPECT_EQ(read_buffer(device(), buffer), expected);
  EXPECT_THAT(error_of([&] { upload_buffer(device(), buffer, ones, 13); }).what(),
              HasSubstr("does not fit into buffer 'bytes' of 16 bytes"));
}

TEST_F(TransferTest, LargerThanTheStagingBufferGoesInPieces) {
  const std::vector<std::byte> bytes = noise((65u << 20) + 3, 7);
  const Buffer buffer(device(), bytes.size(), 0, MemoryKind::device, "large");
  upload_buffer(device(), buffer, bytes);
  EXPECT_TRUE(read_buffer(device(), buffer) == bytes);
}

using LimitTest = test::DeviceTest;

TEST_F(LimitTest, ImageBeyondALimitNamesItAndTheLimit) {
  const uint32_t limit = device().info().limits.maxImageDimension2D;
  const Error error = error_of([&] {
    const Image image(device(),
                      {.format = VK_FORMAT_R8_UNORM, .extent = {limit + 1, 1, 1}, .usage = kUsage, .name = "too wide"});
  });
  EXPECT_EQ(error.code(), ExitCode::run_failed);
  EXPECT_THAT(error.what(), HasSubstr("image 'too wide' (" + std::to_string(limit + 1) + "x1)"));
  EXPECT_THAT(error.what(), HasSubstr("texels of width"));
}

TEST_F(LimitTest, ImageBeyondTheMemoryNamesTheBytes) {
  const uint32_t side = device().info().limits.maxImageDimension2D;
  const uint32_t layers = device().info().limits.maxImageArrayLayers;
  const Error error = error_of([&] {
    const Image image(device(), {.format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                 .extent = {side, side, 1},
                                 .layers = layers,
                                 .usage = kUsage,
                                 .name = "huge"});
  });
  EXPECT_EQ(error.code(), ExitCode::run_failed);
  EXPECT_THAT(error.what(), HasSubstr("image 'huge'"));
}

TEST_F(LimitTest, BufferBeyondTheStorageLimitNamesBoth) {
  const uint64_t limit = device().info().limits.maxStorageBufferRange;
  const Error error = error_of([&] {
    const Buffer buffer(device(), limit + 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "triangles");
  });
  EXPECT_THAT(error.what(), HasSubstr("buffer 'triangles' has " + bytes_text(limit + 4)));
  EXPECT_THAT(error.what(), HasSubstr("storage buffer"));
  EXPECT_THROW(Buffer(device(), 0, 0, MemoryKind::device), Error);
}

TEST_F(LimitTest, ShapesThatContradictThemselvesAreErrors) {
  const auto make = [&](const ImageSpec& spec) { return error_of([&] { const Image image(device(), spec); }); };
  EXPECT_THAT(make({.format = VK_FORMAT_R8_UNORM, .extent = {4, 4, 2}, .usage = kUsage}).what(), HasSubstr("depth"));
  EXPECT_THAT(make({.format = VK_FORMAT_R8_UNORM, .extent = {0, 4, 1}, .usage = kUsage}).what(), HasSubstr("extent"));
  EXPECT_THAT(
      make(
          {.format = VK_FORMAT_R8_UNORM, .dimension = Dimension::d3, .extent = {4, 4, 4}, .layers = 2, .usage = kUsage})
          .what(),
      HasSubstr("layers"));
}

TEST(BytesText, ShowsMebibytesOnlyForLargeNumbers) {
  EXPECT_EQ(bytes_text(12), "12 bytes");
  EXPECT_EQ(bytes_text(12u << 20), "12.0 MiB (12582912 bytes)");
}

}  // namespace
}  // namespace lightloom::gpu
