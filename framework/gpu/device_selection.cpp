#include "framework/gpu/device_selection.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

struct CoreFeature {
  VkBool32 VkPhysicalDeviceFeatures::*member;
  const char* name;
};
constexpr std::array<CoreFeature, 4> kCoreFeatures{{
    {&VkPhysicalDeviceFeatures::fragmentStoresAndAtomics, "fragmentStoresAndAtomics"},
    {&VkPhysicalDeviceFeatures::vertexPipelineStoresAndAtomics, "vertexPipelineStoresAndAtomics"},
    {&VkPhysicalDeviceFeatures::shaderStorageImageWriteWithoutFormat, "shaderStorageImageWriteWithoutFormat"},
    {&VkPhysicalDeviceFeatures::shaderStorageImageExtendedFormats, "shaderStorageImageExtendedFormats"},
}};

struct Feature13 {
  VkBool32 VkPhysicalDeviceVulkan13Features::*member;
  const char* name;
};
// The last three are what SPIR-V 1.6 of GLSL's `discard` and `local_size` needs.
constexpr std::array<Feature13, 5> kFeatures13{{
    {&VkPhysicalDeviceVulkan13Features::synchronization2, "synchronization2"},
    {&VkPhysicalDeviceVulkan13Features::dynamicRendering, "dynamicRendering"},
    {&VkPhysicalDeviceVulkan13Features::maintenance4, "maintenance4"},
    {&VkPhysicalDeviceVulkan13Features::shaderTerminateInvocation, "shaderTerminateInvocation"},
    {&VkPhysicalDeviceVulkan13Features::shaderDemoteToHelperInvocation, "shaderDemoteToHelperInvocation"},
}};

DeviceType device_type(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceType::discrete_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceType::integrated_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceType::virtual_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceType::cpu;
    default:
      return DeviceType::other;
  }
}

DeviceInfo read_info(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device, &properties);
  DeviceInfo info;
  info.name = properties.deviceName;
  info.type = device_type(properties.deviceType);
  info.api_version = properties.apiVersion;
  info.vendor_id = properties.vendorID;
  info.device_id = properties.deviceID;
  info.limits = properties.limits;
  if (properties.apiVersion < VK_API_VERSION_1_2) return info;

  VkPhysicalDeviceVulkan12Properties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
  VkPhysicalDeviceVulkan11Properties identity{};
  identity.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  identity.pNext = &driver;
  VkPhysicalDeviceProperties2 chain{};
  chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  chain.pNext = &identity;
  vkGetPhysicalDeviceProperties2(device, &chain);
  info.driver = driver.driverName;
  info.driver_info = driver.driverInfo;
  info.max_allocation_bytes = identity.maxMemoryAllocationSize;
  std::copy(std::begin(identity.deviceUUID), std::end(identity.deviceUUID), info.uuid.begin());
  info.has_memory_budget = has_device_extension(device, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
  info.ray_query = read_ray_query_support(device);
  return info;
}

std::string find_missing(VkPhysicalDevice device, const DeviceInfo& info) {
  if (info.api_version < VK_API_VERSION_1_3) {
    return "Vulkan 1.3 (it has " + info.api_version_text() + ")";
  }
  VkQueueFamilyProperties family{};
  if (find_queue_family(device, family) < 0) return "a queue for graphics and compute";
  FeatureChain chain(false);
  vkGetPhysicalDeviceFeatures2(device, &chain.core);
  std::string missing;
  const auto note = [&](bool there, const char* name) {
    if (there) return;
    missing += missing.empty() ? "the feature " : ", ";
    missing += name;
  };
  for (const CoreFeature& feature : kCoreFeatures) note(chain.core.features.*feature.member == VK_TRUE, feature.name);
  for (const Feature13& feature : kFeatures13) note(chain.vulkan13.*feature.member == VK_TRUE, feature.name);
  return missing;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string list_text(std::span<const DeviceSummary> devices) {
  std::string text;
  for (size_t i = 0; i < devices.size(); ++i) {
    text += (i == 0 ? "[" : "; [") + std::to_string(i) + "] " + devices[i].info.name;
    if (!devices[i].usable) text += " (not usable, lacks " + devices[i].missing + ")";
  }
  return text;
}

size_t choose_named(std::span<const DeviceSummary> devices, const std::string& wanted) {
  const bool is_index = wanted.size() <= 4 &&
                        std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const DeviceSummary* match = nullptr;
  for (size_t i = 0; i < devices.size(); ++i) {
    const bool fits =
        is_index ? std::stoul(wanted) == i : lower(devices[i].info.name).find(lower(wanted)) != std::string::npos;
    if (!fits) continue;
    if (devices[i].usable) return i;
    if (match == nullptr) match = &devices[i];
  }
  if (match != nullptr) {
    throw Error(ExitCode::no_device, "device '" + match->info.name + "' cannot be used, it lacks " + match->missing);
  }
  throw Error(ExitCode::no_device, "no device fits '" + wanted + "'; there is " + list_text(devices),
              "give a part of a name, or an index, by --device or LIGHTLOOM_DEVICE");
}

}  // namespace

FeatureChain::FeatureChain(bool ray_queries) {
  vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  core.pNext = &vulkan13;
  buffer_address.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
  acceleration_structure.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
  ray_query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
  if (!ray_queries) return;
  vulkan13.pNext = &buffer_address;
  buffer_address.pNext = &acceleration_structure;
  acceleration_structure.pNext = &ray_query;
}

void enable_features(FeatureChain& chain) {
  for (const CoreFeature& feature : kCoreFeatures) chain.core.features.*feature.member = VK_TRUE;
  for (const Feature13& feature : kFeatures13) chain.vulkan13.*feature.member = VK_TRUE;
  chain.buffer_address.bufferDeviceAddress = VK_TRUE;
  chain.acceleration_structure.accelerationStructure = VK_TRUE;
  chain.ray_query.rayQuery = VK_TRUE;
}

int find_queue_family(VkPhysicalDevice device, VkQueueFamilyProperties& properties) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & kNeeded) != kNeeded) continue;
    properties = families[i];
    return static_cast<int>(i);
  }
  return -1;
}

DeviceSummary describe_device(VkPhysicalDevice device) {
  DeviceSummary summary;
  summary.info = read_info(device);
  summary.missing = find_missing(device, summary.info);
  summary.usable = summary.missing.empty();
  return summary;
}

bool has_device_extension(VkPhysicalDevice device, const char* name) {
  uint32_t count = 0;
  constexpr const char* kAsked = "asking a device for its extensions";
  require_driver(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), kAsked);
  std::vector<VkExtensionProperties> extensions(count);
  require_driver(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()), kAsked);
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const auto& extension) { return std::strcmp(extension.extensionName, name) == 0; });
}

size_t choose_device(std::span<const DeviceSummary> devices, const std::string& wanted) {
  const std::string hint = "install a driver for Vulkan 1.3; the package mesa-vulkan-drivers renders on the CPU";
  if (devices.empty()) throw Error(ExitCode::no_device, "there is no Vulkan device on this machine", hint);
  if (!wanted.empty()) return choose_named(devices, wanted);
  const auto best = std::min_element(devices.begin(), devices.end(), [](const auto& a, const auto& b) {
    return std::pair(!a.usable, a.info.type) < std::pair(!b.usable, b.info.type);
  });
  if (!best->usable) {
    throw Error(ExitCode::no_device, "no Vulkan device can be used; there is " + list_text(devices), hint);
  }
  return static_cast<size_t>(best - devices.begin());
}

std::vector<DeviceSummary> list_devices() {
  std::optional<Instance> instance;
  try {
    instance.emplace(false);
  } catch (const Error& error) {
    // Without a driver there is no device to list.
    if (error.code() != ExitCode::no_device) throw;
    return {};
  }
  std::vector<DeviceSummary> devices;
  for (VkPhysicalDevice device : instance->physical_devices()) devices.push_back(describe_device(device));
  return devices;
}

}  // namespace lightloom::gpu
