#include "framework/gpu/device.hpp"

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/gpu/device_selection.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

constexpr uint64_t kHangSeconds = 120;

/// How long the device may work on one submission [s]; 0: without end. A CPU's frame may take hours, and does not hang.
uint64_t patience(DeviceType type) {
  const char* environment = std::getenv("LIGHTLOOM_DEVICE_TIMEOUT");
  if (environment == nullptr || *environment == '\0') return type == DeviceType::cpu ? 0 : kHangSeconds;
  uint64_t seconds = 0;
  const std::string_view text = environment;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  constexpr uint64_t kMost = 1'000'000;
  if (error == std::errc() && end == text.data() + text.size() && seconds <= kMost) return seconds;
  throw Error(ExitCode::usage,
              "LIGHTLOOM_DEVICE_TIMEOUT is '" + std::string(text) + "', not a number of seconds from 0 to 1000000",
              "0 waits without end");
}

std::string wanted_name(const DeviceOptions& options) {
  if (!options.name.empty()) return options.name;
  const char* environment = std::getenv("LIGHTLOOM_DEVICE");
  return environment != nullptr ? environment : "";
}

}  // namespace

std::string to_string(DeviceType type) {
  switch (type) {
    case DeviceType::discrete_gpu:
      return "discrete GPU";
    case DeviceType::integrated_gpu:
      return "integrated GPU";
    case DeviceType::virtual_gpu:
      return "virtual GPU";
    case DeviceType::cpu:
      return "CPU";
    case DeviceType::other:
      break;
  }
  return "other";
}

std::string DeviceInfo::api_version_text() const {
  return std::to_string(VK_API_VERSION_MAJOR(api_version)) + "." + std::to_string(VK_API_VERSION_MINOR(api_version)) +
         "." + std::to_string(VK_API_VERSION_PATCH(api_version));
}

std::string DeviceInfo::uuid_text() const {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (uint8_t byte : uuid) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

Device::Device(const DeviceOptions& options) : instance_(options.validate) {
  const std::vector<VkPhysicalDevice> physical_devices = instance_.physical_devices();
  std::vector<DeviceSummary> summaries;
  for (VkPhysicalDevice device : physical_devices) summaries.push_back(describe_device(device));
  const size_t chosen = choose_device(summaries, wanted_name(options));
  physical_ = physical_devices[chosen];
  info_ = summaries[chosen].info;
  patience_ = patience(info_.type);
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  create_device(options.validate);
  try {
    create_commands();
  } catch (...) {
    fence_ = {};
    command_pool_ = {};
    vkDestroyDevice(device_, nullptr);
    throw;
  }
}

void Device::create_device(bool validate) {
  VkQueueFamilyProperties family{};
  queue_family_ = static_cast<uint32_t>(find_queue_family(physical_, family));
  timestamp_bits_ = family.timestampValidBits;

  FeatureChain features(info_.ray_query.available);
  enable_features(features);
  if (validate) {
    VkPhysicalDeviceFeatures available{};
    vkGetPhysicalDeviceFeatures(physical_, &available);
    features.core.features.robustBufferAccess = available.robustBufferAccess;
  }
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  std::vector<const char*> extensions;
  constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";
  if (has_device_extension(physical_, kPortabilitySubset)) extensions.push_back(kPortabilitySubset);
  if (info_.ray_query.available)
    for (const char* extension : ray_query_extensions()) extensions.push_back(extension);

  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features.core;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = vkCreateDevice(physical_, &info, nullptr, &device_);
  if (result != VK_SUCCESS) {
    throw Error(ExitCode::no_device,
                "device '" + info_.name + "' cannot be opened: vkCreateDevice gave " + result_name(result));
  }
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
  if (validate) {
    set_object_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetInstanceProcAddr(instance_.get(), "vkSetDebugUtilsObjectNameEXT"));
  }
}

void Device::create_commands() {
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = queue_family_;
  VkCommandPool command_pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device_, &pool, nullptr, &command_pool), "vkCreateCommandPool");
  command_pool_ = CommandPoolHandle(ref(), command_pool);

  VkCommandBufferAllocateInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  buffer.commandPool = command_pool;
  buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_, &buffer, &command_buffer_), "vkAllocateCommandBuffers");

  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(device_, &fence_info, nullptr, &fence), "vkCreateFence");
  fence_ = FenceHandle(ref(), fence);
}

Device::~Device() {
  if (hangs_) {
    // Freeing waits for the work, or pulls the memory away under it; what still runs dies with the process.
    instance_.abandon();
    return;
  }
  if (!lost_) vkDeviceWaitIdle(device_);
  fence_ = {};
  command_pool_ = {};
  vkDestroyDevice(device_, nullptr);
}

void Device::run_commands(const std::function<void(VkCommandBuffer)>& record) {
  record(begin_commands());
  finish_commands();
}

VkCommandBuffer Device::begin_commands() {
  wait_commands();
  check(vkResetCommandPool(device_, command_pool_.get(), 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(command_buffer_, &begin), "vkBeginCommandBuffer");
  return command_buffer_;
}

void Device::finish_commands() {
  submit_commands();
  wait_commands();
}

void Device::submit_commands() {
  check(vkEndCommandBuffer(command_buffer_), "vkEndCommandBuffer");
  VkCommandBufferSubmitInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  commands.commandBuffer = command_buffer_;
  VkSubmitInfo2 submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &commands;
  const VkFence fence = fence_.get();
  check(vkResetFences(device_, 1, &fence), "vkResetFences");
  const VkResult submitted = vkQueueSubmit2(queue_, 1, &submit, fence);
  lost_ = lost_ || submitted == VK_ERROR_DEVICE_LOST;
  check(submitted, "vkQueueSubmit2 on '" + info_.name + "'");
  running_ = true;
}

void Device::wait_commands() {
  if (!running_) return;
  running_ = false;
  const VkFence fence = fence_.get();
  constexpr uint64_t kNanoseconds = 1'000'000'000;
  const uint64_t limit = patience_ == 0 ? UINT64_MAX : patience_ * kNanoseconds;
  const VkResult waited = vkWaitForFences(device_, 1, &fence, VK_TRUE, limit);
  hangs_ = hangs_ || waited == VK_TIMEOUT;
  lost_ = lost_ || waited == VK_ERROR_DEVICE_LOST;
  check(waited, "waiting for '" + info_.name + "'");
  if (waited == VK_TIMEOUT) {
    throw DeviceLost("device '" + info_.name + "' did not finish its work within " + std::to_string(patience_) + " s",
                     "it hangs, or the work is too much for it: try a smaller --size or another --device, or set "
                     "LIGHTLOOM_DEVICE_TIMEOUT to more seconds");
  }
}

void Device::set_name(VkObjectType type, uint64_t object, const std::string& name) const {
  if (set_object_name_ == nullptr || name.empty()) return;
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = name.c_str();
  check(set_object_name_(device_, &info), "vkSetDebugUtilsObjectNameEXT");
}

}  // namespace lightloom::gpu
