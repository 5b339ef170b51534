#include "framework/gpu/buffer_pieces.hpp"

#include <gtest/gtest.h>

#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

TEST(BufferPieces, AreTheLargestThatFit) {
  EXPECT_EQ(pieces_of(0, 64, 128 << 20).count, 1u);
  EXPECT_EQ(pieces_of(1, 64, 128 << 20).bits, 21u);
  EXPECT_EQ(pieces_of(1 << 21, 64, 128 << 20).count, 1u);
  EXPECT_EQ(pieces_of((1 << 21) + 1, 64, 128 << 20).count, 2u);
  EXPECT_EQ(pieces_of(1, 20, 128 << 20).bits, 22u) << "6.7 million fit, which is no power of two";
  EXPECT_EQ(pieces_of(10'000'000, 20, 128 << 20).count, 3u);
  EXPECT_EQ(pieces_of(1, 64, 100).bits, 8u) << "so many begin at a multiple of 256 bytes";
  EXPECT_EQ(pieces_of(1, 1, uint64_t{1} << 40).bits, 31u);
}

class BoundPieces : public test::DeviceTest {};

TEST_F(BoundPieces, CoverTheBufferOnceAndRepeatTheFirst) {
  const Buffer buffer(device(), 600 * 20, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "numbers",
                      BufferBinding::pieces);
  const auto blocks = std::get<std::vector<BufferResource>>(resource(buffer, pieces_of(600, 20, 6000), 20, 4));
  ASSERT_EQ(blocks.size(), 4u);
  EXPECT_EQ(blocks[0].offset, 0u);
  EXPECT_EQ(blocks[0].range, 256u * 20);
  EXPECT_EQ(blocks[1].offset, 256u * 20);
  EXPECT_EQ(blocks[2].offset, 512u * 20);
  EXPECT_EQ(blocks[2].range, 88u * 20);
  EXPECT_EQ(blocks[3].offset, 0u);
}

TEST_F(BoundPieces, MayBeMoreTogetherThanADeviceBindsAtOnce) {
  const VkDeviceSize limit = device().info().limits.maxStorageBufferRange;
  if (limit > (VkDeviceSize{1} << 30)) GTEST_SKIP() << "this device binds " << limit << " bytes at once";
  const Buffer buffer(device(), limit + 64, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "numbers",
                      BufferBinding::pieces);
  EXPECT_EQ(buffer.size(), limit + 64);
}

}  // namespace
}  // namespace lightloom::gpu
