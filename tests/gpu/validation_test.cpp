// Positive controls: what the other tests rely on, that a silent validation layer is one that listens.
#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/transfer.hpp"
#include "tests/gpu/gpu_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kWrite = R"(
layout(local_size_x = 64) in;
layout(std430) buffer First { uint first[]; };
void main() { first[gl_GlobalInvocationID.x] = gl_GlobalInvocationID.x; }
)";
constexpr const char* kReverse = R"(
layout(local_size_x = 64) in;
layout(std430) readonly buffer First { uint first[]; };
layout(std430) writeonly buffer Second { uint second[]; };
void main() { second[gl_GlobalInvocationID.x] = first[63u - gl_GlobalInvocationID.x]; }
)";

/// One dispatch writes a buffer that the next one reads, with or without a barrier between them. (Of two dispatches
/// that both write, layer 1.3.239 says nothing.)
std::vector<ValidationMessage> write_then_read(Device& device, bool with_barrier) {
  const Pipeline write(device, test::compile_compute(kWrite), {});
  const Pipeline reverse(device, test::compile_compute(kReverse), {});
  const Buffer first(device, 256, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "first");
  const Buffer second(device, 256, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "second");
  const ResourceMap resources{{"First", resource(first)}, {"Second", resource(second)}};
  DescriptorAllocator descriptors(device);
  const VkDescriptorSet write_set = descriptors.allocate(write, resources);
  const VkDescriptorSet reverse_set = descriptors.allocate(reverse, resources);
  device.run_commands([&](VkCommandBuffer commands) {
    write.bind(commands, write_set, {});
    vkCmdDispatch(commands, 1, 1, 1);
    if (with_barrier) record_full_barrier(commands);
    reverse.bind(commands, reverse_set, {});
    vkCmdDispatch(commands, 1, 1, 1);
  });
  return device.validation_messages();
}

TEST(Validation, ReportsAHazardWhereABarrierIsMissing) {
  Device device({.name = "", .validate = true});
  ASSERT_TRUE(device.validating());
  EXPECT_THAT(write_then_read(device, true), IsEmpty());
  const std::vector<ValidationMessage> messages = write_then_read(device, false);
  EXPECT_THAT(messages, Contains(Field(&ValidationMessage::id, "SYNC-HAZARD-READ-AFTER-WRITE")));
  EXPECT_THAT(messages, Contains(Field(&ValidationMessage::error, true)));
  device.clear_validation_messages();
  EXPECT_THAT(device.validation_messages(), IsEmpty());
}

TEST(Validation, ManyMessagesAreCounted) {
  ValidationLog log;
  for (int i = 0; i < 1000; ++i) log.add({i == 999, "id", "text"});
  const std::vector<ValidationMessage> messages = log.messages();
  ASSERT_EQ(messages.size(), ValidationLog::kMostMessages + 1);
  EXPECT_EQ(messages.back().text, "and 744 more messages, not kept");
  EXPECT_TRUE(messages.back().error);
  log.clear();
  EXPECT_THAT(log.messages(), IsEmpty());
}

TEST(Validation, ReportsAMisuseOfTheApi) {
  Device device({.name = "", .validate = true});
  const Buffer buffer(device, 16, 0, MemoryKind::device, "sixteen bytes");
  // Recorded but, by the exception, never run: it would write outside of the buffer.
  EXPECT_THROW(device.run_commands([&](VkCommandBuffer commands) {
    vkCmdFillBuffer(commands, buffer.get(), 0, 64, 0);
    throw Error(ExitCode::run_failed, "stop");
  }),
               Error);
  EXPECT_THAT(device.validation_messages(),
              Contains(Field(&ValidationMessage::text, HasSubstr("VUID-vkCmdFillBuffer-size-00027"))));
  EXPECT_THAT(device.validation_messages(), Contains(Field(&ValidationMessage::text, HasSubstr("sixteen bytes"))));
}

TEST(Validation, IsOffUnlessAskedFor) {
  const Device device;
  EXPECT_FALSE(device.validating());
}

}  // namespace
}  // namespace lightloom::gpu
