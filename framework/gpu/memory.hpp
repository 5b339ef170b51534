#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>

#include "framework/gpu/device.hpp"

namespace lightloom::gpu {

/// Where memory lies. The host-visible kinds are always coherent: no flush, no invalidate.
enum class MemoryKind : uint8_t {
  device,    ///< fastest for the device; not mapped
  upload,    ///< the host writes, in order
  readback,  ///< the host reads; cached where the device has such memory
};

/// Memory of a device, which the device's ledger counts as long as it is held.
class Memory {
 public:
  Memory() = default;
  Memory(const Device& device, VkDeviceMemory memory, MemoryPurpose purpose, uint64_t bytes);
  Memory(Memory&& other) noexcept;
  Memory& operator=(Memory&& other) noexcept;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory();
  [[nodiscard]] VkDeviceMemory get() const { return handle_.get(); }

 private:
  MemoryHandle handle_;
  MemoryLedger* ledger_ = nullptr;  ///< of the device, which outlives it; none where there is no memory
  MemoryPurpose purpose_ = MemoryPurpose::buffers;
  uint64_t bytes_ = 0;
};

/// One allocation for one resource. Throws Error(run_failed) that says how much was asked and what the limit is.
/// @param owner in words, for messages: "image 'trace.radiance' (rgba16_sfloat 640x480)"
[[nodiscard]] Memory allocate_memory(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                                     const std::string& owner, const VkMemoryDedicatedAllocateInfo& dedicated);
/// The same for memory that several resources share.
[[nodiscard]] Memory allocate_memory(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                                     const std::string& owner);

/// Memory that images of the device can still have [bytes]: what the driver's budget leaves (VK_EXT_memory_budget),
/// else the largest heap of device memory. For a CPU device it is the host's free memory: a heap of lavapipe says 2 GiB
/// whatever there is.
[[nodiscard]] uint64_t available_bytes(const Device& device);

[[nodiscard]] std::string bytes_text(uint64_t bytes);  ///< "12.0 MiB (12582912 bytes)"

}  // namespace lightloom::gpu
