#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"

namespace lightloom::gpu {

[[nodiscard]] DeviceSummary describe_device(VkPhysicalDevice device);

[[nodiscard]] bool has_device_extension(VkPhysicalDevice device, const char* name);

/// Index into `devices` of the one that `wanted` names; see DeviceOptions::name, without the environment.
/// Throws Error(no_device).
[[nodiscard]] size_t choose_device(std::span<const DeviceSummary> devices, const std::string& wanted);

/// Family with graphics and compute, or -1.
[[nodiscard]] int find_queue_family(VkPhysicalDevice device, VkQueueFamilyProperties& properties);

/// The features that the framework uses, in the chain that vkGetPhysicalDeviceFeatures2 and vkCreateDevice take.
struct FeatureChain {
  VkPhysicalDeviceFeatures2 core{};
  VkPhysicalDeviceVulkan13Features vulkan13{};
  FeatureChain();
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;
};

/// Sets each required feature of `chain`.
void enable_required_features(FeatureChain& chain);

}  // namespace lightloom::gpu
