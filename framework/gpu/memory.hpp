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

/// One allocation for one resource. Throws Error(run_failed) that says how much was asked and what the limit is.
/// @param owner in words, for messages: "image 'trace.radiance' (rgba16_sfloat 640x480)"
[[nodiscard]] MemoryHandle allocate_memory(const Device& device, const VkMemoryRequirements& requirements,
                                           MemoryKind kind, const std::string& owner,
                                           const VkMemoryDedicatedAllocateInfo& dedicated);
/// The same for memory that several resources share.
[[nodiscard]] MemoryHandle allocate_memory(const Device& device, const VkMemoryRequirements& requirements,
                                           MemoryKind kind, const std::string& owner);

/// Memory that images of the device can still have [bytes]: what the driver's budget leaves (VK_EXT_memory_budget),
/// else the largest heap of device memory. For a CPU device it is the host's free memory: a heap of lavapipe says 2 GiB
/// whatever there is.
[[nodiscard]] uint64_t available_bytes(const Device& device);

[[nodiscard]] std::string bytes_text(uint64_t bytes);  ///< "12.0 MiB (12582912 bytes)"

}  // namespace lightloom::gpu
