#include "framework/gpu/buffer.hpp"

#include <utility>

#include "framework/base/error.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

void check_limits(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, BufferBinding binding,
                  const std::string& owner) {
  if (size == 0) throw Error(ExitCode::run_failed, owner + " has no bytes; a buffer has at least one");
  const VkPhysicalDeviceLimits& limits = device.info().limits;
  const auto require = [&](VkBufferUsageFlags flag, uint64_t limit, const char* what) {
    if ((usage & flag) == 0 || size <= limit) return;
    throw Error(ExitCode::run_failed,
                owner + " has " + bytes_text(size) + ", more than the " + bytes_text(limit) + " of a " + what +
                    " buffer on device '" + device.info().name + "'",
                "the scene or the graph is too large for this device");
  };
  // What is reached by its address is not bound as a range.
  if ((usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) == 0 && binding == BufferBinding::whole)
    require(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, limits.maxStorageBufferRange, "storage");
  require(VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, limits.maxUniformBufferRange, "uniform");
}

}  // namespace

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind, std::string name,
               BufferBinding binding)
    : name_(std::move(name)), size_(size) {
  const std::string owner = "buffer '" + name_ + "'";
  check_limits(device, size, usage, binding, owner);
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device.get(), &info, nullptr, &buffer), "vkCreateBuffer for " + owner);
  buffer_ = BufferHandle(device.ref(), buffer);
  device.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), name_);

  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.get(), buffer, &requirements);
  VkMemoryDedicatedAllocateInfo dedicated{};
  dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  dedicated.buffer = buffer;
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  if ((usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0) dedicated.pNext = &flags;
  memory_ = allocate_memory(device, requirements, kind, owner, dedicated);
  check(vkBindBufferMemory(device.get(), buffer, memory_.get(), 0), "vkBindBufferMemory for " + owner);
  if (kind == MemoryKind::device) return;
  void* data = nullptr;
  check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &data), "vkMapMemory for " + owner);
  mapped_ = {static_cast<std::byte*>(data), size};
}

VkDeviceAddress Buffer::address(const Device& device) const {
  VkBufferDeviceAddressInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  info.buffer = get();
  return vkGetBufferDeviceAddress(device.get(), &info);
}

}  // namespace lightloom::gpu
