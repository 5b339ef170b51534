#pragma once

#include <vulkan/vulkan_core.h>

#include <utility>

namespace lightloom::gpu {

/// A device as its objects know it; the Device outlives them.
struct DeviceRef {
  VkDevice device = VK_NULL_HANDLE;
  const bool* hangs =
      nullptr;  ///< it did not finish its work, so nothing of it may be freed: that would crash, or wait
};

/// Owner of one Vulkan object of a device. `Destroy` is the Vulkan function that frees it.
template <class T, auto Destroy>
class Handle {
 public:
  Handle() = default;
  Handle(const DeviceRef& device, T object) : device_(device), object_(object) {}
  Handle(Handle&& other) noexcept
      : device_(other.device_), object_(std::exchange(other.object_, static_cast<T>(VK_NULL_HANDLE))) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(object_, other.object_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (object_ != VK_NULL_HANDLE && !*device_.hangs) Destroy(device_.device, object_, nullptr);
  }
  [[nodiscard]] T get() const { return object_; }

 private:
  DeviceRef device_;
  T object_ = VK_NULL_HANDLE;
};

using BufferHandle = Handle<VkBuffer, vkDestroyBuffer>;
using CommandPoolHandle = Handle<VkCommandPool, vkDestroyCommandPool>;
using DescriptorPoolHandle = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using DescriptorSetLayoutHandle = Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using FenceHandle = Handle<VkFence, vkDestroyFence>;
using ImageHandle = Handle<VkImage, vkDestroyImage>;
using ImageViewHandle = Handle<VkImageView, vkDestroyImageView>;
using MemoryHandle = Handle<VkDeviceMemory, vkFreeMemory>;
using PipelineCacheHandle = Handle<VkPipelineCache, vkDestroyPipelineCache>;
using PipelineHandle = Handle<VkPipeline, vkDestroyPipeline>;
using PipelineLayoutHandle = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using QueryPoolHandle = Handle<VkQueryPool, vkDestroyQueryPool>;
using SamplerHandle = Handle<VkSampler, vkDestroySampler>;
using ShaderModuleHandle = Handle<VkShaderModule, vkDestroyShaderModule>;

}  // namespace lightloom::gpu
