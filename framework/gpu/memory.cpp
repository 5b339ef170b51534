#include "framework/gpu/memory.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <optional>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

std::optional<uint32_t> find_type(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                  VkMemoryPropertyFlags wanted) {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const bool fits = (memory.memoryTypes[i].propertyFlags & wanted) == wanted;
    if (fits && (allowed & (1u << i)) != 0) return i;
  }
  return std::nullopt;
}

/// Properties to ask for, best first. A host-visible coherent type always exists for buffers, any type for images.
std::array<VkMemoryPropertyFlags, 2> wishes(MemoryKind kind) {
  constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (kind) {
    case MemoryKind::device:
      return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    case MemoryKind::upload:
      return {kHost, kHost};
    case MemoryKind::readback:
      break;
  }
  return {kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kHost};
}

uint32_t choose_type(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                     const std::string& owner) {
  for (VkMemoryPropertyFlags wanted : wishes(kind)) {
    if (const auto type = find_type(device.memory(), requirements.memoryTypeBits, wanted)) return *type;
  }
  throw Error(ExitCode::run_failed, "device '" + device.info().name + "' has no kind of memory for " + owner);
}

/// MemAvailable of Linux [bytes]; nothing where it is not told.
std::optional<uint64_t> free_host_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  uint64_t kibibytes = 0;
  std::string unit;
  while (file >> name >> kibibytes && std::getline(file, unit))
    if (name == "MemAvailable:") return kibibytes * 1024;
  return std::nullopt;
}

}  // namespace

uint64_t available_bytes(const Device& device) {
  if (device.info().type == DeviceType::cpu) {
    if (const std::optional<uint64_t> bytes = free_host_bytes()) return *bytes;
  }
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
  budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
  VkPhysicalDeviceMemoryProperties2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
  if (device.info().has_memory_budget) memory.pNext = &budget;
  vkGetPhysicalDeviceMemoryProperties2(device.physical(), &memory);
  uint64_t most = 0;
  for (uint32_t heap = 0; heap < memory.memoryProperties.memoryHeapCount; ++heap) {
    const VkMemoryHeap& properties = memory.memoryProperties.memoryHeaps[heap];
    if ((properties.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) == 0) continue;
    const uint64_t used = std::min(budget.heapUsage[heap], budget.heapBudget[heap]);
    most = std::max(most, device.info().has_memory_budget ? budget.heapBudget[heap] - used : properties.size);
  }
  return most;
}

std::string bytes_text(uint64_t bytes) {
  const std::string exact = std::to_string(bytes) + " bytes";
  if (bytes < 1024 * 1024) return exact;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
  return std::string(text.data()) + " (" + exact + ")";
}

namespace {

MemoryPurpose purpose_of(MemoryKind kind, const VkMemoryDedicatedAllocateInfo* dedicated) {
  if (kind != MemoryKind::device) return MemoryPurpose::staging;
  if (dedicated == nullptr) return MemoryPurpose::shared;
  return dedicated->image != VK_NULL_HANDLE ? MemoryPurpose::images : MemoryPurpose::buffers;
}

Memory allocate(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                const std::string& owner, const VkMemoryDedicatedAllocateInfo* dedicated) {
  const std::string need = owner + " needs " + bytes_text(requirements.size);
  const uint64_t limit = device.info().max_allocation_bytes;
  if (limit != 0 && requirements.size > limit) {
    throw Error(ExitCode::run_failed,
                need + ", more than the " + bytes_text(limit) + " that device '" + device.info().name +
                    "' gives to one resource",
                "choose a smaller size or resolution");
  }
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.pNext = dedicated;
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = choose_type(device, requirements, kind, owner);
  const VkMemoryHeap& heap = device.memory().memoryHeaps[device.memory().memoryTypes[info.memoryTypeIndex].heapIndex];
  if (requirements.size > heap.size) {
    throw OutOfMemory(need + ", more than the " + bytes_text(heap.size) + " of memory of device '" +
                      device.info().name + "'");
  }
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult result = vkAllocateMemory(device.get(), &info, nullptr, &memory);
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY ||
      result == VK_ERROR_TOO_MANY_OBJECTS) {
    throw OutOfMemory(need + ", but device '" + device.info().name + "' gives no more (" + result_name(result) +
                      "; it has " + bytes_text(available_bytes(device)) + " left, and a heap of " +
                      bytes_text(heap.size) + ")");
  }
  check(result, "vkAllocateMemory for " + owner);
  return {device, memory, purpose_of(kind, dedicated), requirements.size};
}

}  // namespace

Memory::Memory(const Device& device, VkDeviceMemory memory, MemoryPurpose purpose, uint64_t bytes)
    : handle_(device.ref(), memory), ledger_(&device.memory_ledger()), purpose_(purpose), bytes_(bytes) {
  ledger_->add(purpose_, bytes_);
}

Memory::Memory(Memory&& other) noexcept
    : handle_(std::move(other.handle_)),
      ledger_(std::exchange(other.ledger_, nullptr)),
      purpose_(other.purpose_),
      bytes_(other.bytes_) {}

Memory& Memory::operator=(Memory&& other) noexcept {
  std::swap(handle_, other.handle_);
  std::swap(ledger_, other.ledger_);
  std::swap(purpose_, other.purpose_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Memory::~Memory() {
  if (ledger_ != nullptr) ledger_->remove(purpose_, bytes_);
}

Memory allocate_memory(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                       const std::string& owner, const VkMemoryDedicatedAllocateInfo& dedicated) {
  return allocate(device, requirements, kind, owner, &dedicated);
}

Memory allocate_memory(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                       const std::string& owner) {
  return allocate(device, requirements, kind, owner, nullptr);
}

}  // namespace lightloom::gpu
