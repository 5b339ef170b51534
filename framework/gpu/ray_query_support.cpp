#include <algorithm>
#include <array>

#include "framework/gpu/device_selection.hpp"

namespace lightloom::gpu {
namespace {

constexpr std::array kExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                 VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

/// Extensions, or features where all of those are there, that the device lacks; joined by commas.
std::string find_missing(VkPhysicalDevice device) {
  std::string missing;
  const auto note = [&](bool there, const char* name) {
    if (there) return;
    missing += missing.empty() ? "" : ", ";
    missing += name;
  };
  for (const char* extension : kExtensions) note(has_device_extension(device, extension), extension);
  if (!missing.empty()) return missing;
  FeatureChain chain(true);
  vkGetPhysicalDeviceFeatures2(device, &chain.core);
  note(chain.buffer_address.bufferDeviceAddress == VK_TRUE, "the feature bufferDeviceAddress");
  note(chain.acceleration_structure.accelerationStructure == VK_TRUE, "the feature accelerationStructure");
  note(chain.ray_query.rayQuery == VK_TRUE, "the feature rayQuery");
  return missing;
}

}  // namespace

std::span<const char* const> ray_query_extensions() {
  return kExtensions;
}

RayQuerySupport read_ray_query_support(VkPhysicalDevice device) {
  RayQuerySupport support;
  support.missing = find_missing(device);
  support.available = support.missing.empty();
  if (!support.available) return support;
  VkPhysicalDeviceAccelerationStructurePropertiesKHR limits{};
  limits.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
  VkPhysicalDeviceProperties2 chain{};
  chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  chain.pNext = &limits;
  vkGetPhysicalDeviceProperties2(device, &chain);
  support.scratch_alignment = std::max(limits.minAccelerationStructureScratchOffsetAlignment, 1u);
  support.most_primitives = limits.maxPrimitiveCount;
  return support;
}

}  // namespace lightloom::gpu
