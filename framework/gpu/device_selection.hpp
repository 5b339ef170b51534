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
  VkPhysicalDeviceBufferDeviceAddressFeatures buffer_address{};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration_structure{};
  VkPhysicalDeviceRayQueryFeaturesKHR ray_query{};
  /// `ray_queries`: with the three last ones, which a device without their extensions does not know.
  explicit FeatureChain(bool ray_queries);
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;
};

/// Sets each feature of `chain` that is required, or that ray queries need.
void enable_features(FeatureChain& chain);

/// The extensions that ray queries need.
[[nodiscard]] std::span<const char* const> ray_query_extensions();
[[nodiscard]] RayQuerySupport read_ray_query_support(VkPhysicalDevice device);

}  // namespace lightloom::gpu
