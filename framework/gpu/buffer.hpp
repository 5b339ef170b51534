#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "framework/gpu/memory.hpp"

namespace lightloom::gpu {

/// How shaders reach a storage buffer: all of it at once, which devices limit, or in pieces (buffer_pieces.hpp).
enum class BufferBinding : uint8_t { whole, pieces };

/// A buffer with its own memory. TRANSFER_SRC and TRANSFER_DST are always among its usages. SHADER_DEVICE_ADDRESS needs
/// a device with ray queries.
class Buffer {
 public:
  /// @param size [bytes], at least 1
  Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind, std::string name = {},
         BufferBinding binding = BufferBinding::whole);

  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  [[nodiscard]] VkDeviceSize size() const { return size_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Where it lies for the device; only with usage SHADER_DEVICE_ADDRESS.
  [[nodiscard]] VkDeviceAddress address(const Device& device) const;
  /// All of it, for MemoryKind upload and readback; empty for `device`.
  [[nodiscard]] std::span<std::byte> mapped() const { return mapped_; }

 private:
  std::string name_;
  VkDeviceSize size_ = 0;
  Memory memory_;
  BufferHandle buffer_;
  std::span<std::byte> mapped_;
};

}  // namespace lightloom::gpu
