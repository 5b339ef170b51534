#include "framework/gpu/memory_ledger.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/image.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

class Ledger : public test::DeviceTest {
 protected:
  [[nodiscard]] uint64_t now(MemoryPurpose purpose) { return device().memory_ledger().now()[purpose]; }
};

TEST_F(Ledger, CountsWhatIsHeldByWhatItIsFor) {
  const MemoryBytes before = device().memory_ledger().now();
  {
    const Buffer buffer(device(), 1 << 20, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "buffer");
    EXPECT_GE(now(MemoryPurpose::buffers), before[MemoryPurpose::buffers] + (1 << 20));
    const Buffer staging(device(), 1 << 16, 0, MemoryKind::readback, "staging");
    EXPECT_GE(now(MemoryPurpose::staging), before[MemoryPurpose::staging] + (1 << 16));
    const Image image(device(), {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                 .extent = {128, 64, 1},
                                 .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .name = "image"});
    EXPECT_EQ(now(MemoryPurpose::images), before[MemoryPurpose::images] + image.memory_bytes());
    const Memory shared = allocate_memory(device(), image.requirements(), MemoryKind::device, "shared");
    EXPECT_EQ(now(MemoryPurpose::shared), before[MemoryPurpose::shared] + image.memory_bytes());
  }
  EXPECT_EQ(device().memory_ledger().now().of, before.of);
}

TEST_F(Ledger, CountsMemoryOnceThatIsHandedOn) {
  const MemoryBytes before = device().memory_ledger().now();
  {
    Buffer first(device(), 4096, 0, MemoryKind::upload, "first");
    Buffer second(device(), 8192, 0, MemoryKind::upload, "second");
    const uint64_t both = now(MemoryPurpose::staging);
    first = std::move(second);
    Buffer third(std::move(first));
    EXPECT_LE(now(MemoryPurpose::staging), both);
    EXPECT_GE(now(MemoryPurpose::staging), before[MemoryPurpose::staging] + 8192);
  }
  EXPECT_EQ(device().memory_ledger().now().of, before.of);
}

TEST(LedgerAlone, KeepsPeaksOfEachAndOfAllTogether) {
  MemoryLedger ledger;
  ledger.add(MemoryPurpose::images, 100);
  ledger.add(MemoryPurpose::staging, 30);
  ledger.remove(MemoryPurpose::staging, 30);
  ledger.add(MemoryPurpose::shared, 20);
  EXPECT_EQ(ledger.now().total(), 120u);
  EXPECT_EQ(ledger.peaks()[MemoryPurpose::staging], 30u);
  EXPECT_EQ(ledger.peaks().total(), 150u) << "not all at the same time";
  EXPECT_EQ(ledger.peak(), 130u);
}

}  // namespace
}  // namespace lightloom::gpu
