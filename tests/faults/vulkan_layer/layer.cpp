// The Vulkan layer VK_LAYER_LIGHTLOOM_faults: passes every call on, except where fault_plan.hpp says otherwise.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <map>
#include <mutex>
#include <string>

#include "tests/faults/vulkan_layer/fault_plan.hpp"

namespace lightloom::faults {
namespace {

struct Next {
  PFN_vkGetInstanceProcAddr instance_proc = nullptr;
  PFN_vkGetDeviceProcAddr device_proc = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  bool lost = false;
  /// Asked for when the instance was made: later the loader answers with the top of the chain, which leads back here.
  std::map<std::string, PFN_vkVoidFunction> instance_functions{};
};

const std::map<std::string, PFN_vkVoidFunction>& instance_functions();

std::mutex chain_mutex;

/// What stands below this layer, by the loader's dispatch table: the first word of each dispatchable handle, which a
/// device shares with its queues, an instance with its physical devices.
std::map<void*, Next>& chain() {
  static std::map<void*, Next> nexts;
  return nexts;
}

template <typename Handle>
void* key_of(Handle handle) {
  return *reinterpret_cast<void**>(handle);
}

template <typename Handle>
Next next_of(Handle handle) {
  const std::lock_guard lock(chain_mutex);
  return chain().at(key_of(handle));
}

template <typename Function, typename Handle>
Function next_function(Handle handle, const char* name) {
  const Next next = next_of(handle);
  PFN_vkVoidFunction function =
      next.device != VK_NULL_HANDLE ? next.device_proc(next.device, name) : next.instance_functions.at(name);
  return reinterpret_cast<Function>(function);
}

template <typename Handle>
void set_lost(Handle handle) {
  const std::lock_guard lock(chain_mutex);
  chain().at(key_of(handle)).lost = true;
}

template <size_t Size>
struct Name {
  constexpr Name(const char (&text)[Size]) { std::copy_n(text, Size, value); }  // NOLINT: a name is a literal
  char value[Size]{};
};

/// Functions of a lost device that say so.
bool tells_of_loss(const std::string& name) {
  return name.starts_with("vkQueue") || name.ends_with("WaitIdle") || name == "vkWaitForFences";
}

/// A failed call gives no objects, for the functions where Vulkan says so.
template <typename... Arguments>
void clear_objects(Arguments...) {}
void clear_objects(VkPipelineCache, uint32_t count, const VkComputePipelineCreateInfo*, const VkAllocationCallbacks*,
                   VkPipeline* pipelines) {
  std::fill_n(pipelines, count, VkPipeline{});
}
void clear_objects(VkPipelineCache, uint32_t count, const VkGraphicsPipelineCreateInfo*, const VkAllocationCallbacks*,
                   VkPipeline* pipelines) {
  std::fill_n(pipelines, count, VkPipeline{});
}
void clear_objects(const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets) {
  std::fill_n(sets, info->descriptorSetCount, VkDescriptorSet{});
}
void clear_objects(const VkCommandBufferAllocateInfo* info, VkCommandBuffer* buffers) {
  std::fill_n(buffers, info->commandBufferCount, VkCommandBuffer{});
}

template <Name kName, typename Function>
struct Counted;
template <Name kName, typename Handle, typename... Arguments>
struct Counted<kName, VkResult (*)(Handle, Arguments...)> {
  static VkResult call(Handle handle, Arguments... arguments) {
    const std::optional<VkResult> failure = fault_plan().on_call(kName.value);
    const std::string name = kName.value;
    const auto next = next_function<VkResult (*)(Handle, Arguments...)>(handle, kName.value);
    if (failure) {
      // The driver that is not lost must have ended its work before its user drops what the work needs.
      if (name == "vkWaitForFences") static_cast<void>(next(handle, arguments...));
      if (*failure == VK_ERROR_DEVICE_LOST) set_lost(handle);
      clear_objects(arguments...);
      return *failure;
    }
    if (next_of(handle).lost && tells_of_loss(name)) return VK_ERROR_DEVICE_LOST;
    return next(handle, arguments...);
  }
};

VkResult allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                         VkDeviceMemory* memory) {
  if (const auto failure = fault_plan().on_call("vkAllocateMemory")) return *failure;
  if (!fault_plan().take(VK_NULL_HANDLE, info->allocationSize, true)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result =
      next_function<PFN_vkAllocateMemory>(device, "vkAllocateMemory")(device, info, callbacks, memory);
  if (result == VK_SUCCESS) static_cast<void>(fault_plan().take(*memory, info->allocationSize, false));
  return result;
}

void free_memory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
  fault_plan().give_back(memory);
  next_function<PFN_vkFreeMemory>(device, "vkFreeMemory")(device, memory, callbacks);
}

VkResult create_pipeline_cache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                               const VkAllocationCallbacks* callbacks, VkPipelineCache* cache) {
  fault_plan().add("pipeline_cache_bytes", info->initialDataSize);
  return Counted<"vkCreatePipelineCache", PFN_vkCreatePipelineCache>::call(device, info, callbacks, cache);
}

void cap(VkPhysicalDeviceMemoryProperties& memory) {
  const auto bytes = fault_plan().faults().heap_bytes;
  for (uint32_t heap = 0; bytes && heap < memory.memoryHeapCount; ++heap)
    memory.memoryHeaps[heap].size = std::min(memory.memoryHeaps[heap].size, *bytes);
}

void memory_properties(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
  next_function<PFN_vkGetPhysicalDeviceMemoryProperties>(device, "vkGetPhysicalDeviceMemoryProperties")(device, memory);
  cap(*memory);
}

template <typename Struct>
Struct* find(void* chained, VkStructureType type) {
  for (auto* link = static_cast<VkBaseOutStructure*>(chained); link != nullptr; link = link->pNext)
    if (link->sType == type) return reinterpret_cast<Struct*>(link);
  return nullptr;
}

void memory_properties2(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2* memory) {
  next_function<PFN_vkGetPhysicalDeviceMemoryProperties2>(device, "vkGetPhysicalDeviceMemoryProperties2")(device,
                                                                                                          memory);
  cap(memory->memoryProperties);
  auto* budget = find<VkPhysicalDeviceMemoryBudgetPropertiesEXT>(
      memory->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT);
  const auto bytes = fault_plan().faults().heap_bytes;
  if (budget == nullptr || !bytes) return;
  for (uint32_t heap = 0; heap < memory->memoryProperties.memoryHeapCount; ++heap) {
    budget->heapBudget[heap] = *bytes;
    budget->heapUsage[heap] = fault_plan().taken();
  }
}

void change(VkPhysicalDeviceProperties& properties) {
  const Faults faults = fault_plan().faults();
  if (faults.api_version) properties.apiVersion = *faults.api_version;
  if (faults.discrete) properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

void device_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
  next_function<PFN_vkGetPhysicalDeviceProperties>(device, "vkGetPhysicalDeviceProperties")(device, properties);
  change(*properties);
}

void device_properties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
  next_function<PFN_vkGetPhysicalDeviceProperties2>(device, "vkGetPhysicalDeviceProperties2")(device, properties);
  change(properties->properties);
}

void device_features2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
  next_function<PFN_vkGetPhysicalDeviceFeatures2>(device, "vkGetPhysicalDeviceFeatures2")(device, features);
  const std::set<std::string> hidden = fault_plan().faults().hidden;
  VkPhysicalDeviceFeatures& core = features->features;
  if (hidden.contains("fragmentStoresAndAtomics")) core.fragmentStoresAndAtomics = VK_FALSE;
  if (hidden.contains("shaderStorageImageExtendedFormats")) core.shaderStorageImageExtendedFormats = VK_FALSE;
  auto* newer =
      find<VkPhysicalDeviceVulkan13Features>(features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  if (newer == nullptr) return;
  if (hidden.contains("synchronization2")) newer->synchronization2 = VK_FALSE;
  if (hidden.contains("dynamicRendering")) newer->dynamicRendering = VK_FALSE;
  if (hidden.contains("maintenance4")) newer->maintenance4 = VK_FALSE;
}

/// The loader's list of layers below, which each layer moves on by one.
template <typename CreateInfo>
CreateInfo* link_of(const void* chained, VkStructureType type) {
  for (auto* link = static_cast<const VkBaseInStructure*>(chained); link != nullptr; link = link->pNext) {
    if (link->sType != type) continue;
    auto* info = const_cast<CreateInfo*>(reinterpret_cast<const CreateInfo*>(link));
    if (info->function == VK_LAYER_LINK_INFO) return info;
  }
  return nullptr;
}

VkResult create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                         VkInstance* instance) {
  auto* link = link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  try {
    fault_plan().load();
  } catch (const std::exception& error) {
    static_cast<void>(std::fprintf(stderr, "LIGHTLOOM_FAULTS is wrong: %s\n", error.what()));
    return VK_ERROR_INITIALIZATION_FAILED;
  }
  if (const auto failure = fault_plan().on_call("vkCreateInstance")) {
    fault_plan().write_log();
    return *failure;
  }
  const PFN_vkGetInstanceProcAddr proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(proc(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, callbacks, instance);
  if (result != VK_SUCCESS) return result;
  Next next{.instance_proc = proc, .instance = *instance};
  for (const auto& [name, ours] : instance_functions()) next.instance_functions[name] = proc(*instance, name.c_str());
  const std::lock_guard lock(chain_mutex);
  chain()[key_of(*instance)] = std::move(next);
  return VK_SUCCESS;
}

void destroy_instance(VkInstance instance, const VkAllocationCallbacks* callbacks) {
  if (instance == VK_NULL_HANDLE) return;
  void* const key = key_of(instance);
  next_function<PFN_vkDestroyInstance>(instance, "vkDestroyInstance")(instance, callbacks);
  fault_plan().write_log();
  const std::lock_guard lock(chain_mutex);
  chain().erase(key);
}

VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                       const VkAllocationCallbacks* callbacks, VkDevice* device) {
  auto* link = link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  if (const auto failure = fault_plan().on_call("vkCreateDevice")) return *failure;
  Next next = next_of(physical);
  next.device_proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(next.instance_functions.at("vkCreateDevice"));
  const VkResult result = create(physical, info, callbacks, device);
  if (result != VK_SUCCESS) return result;
  next.device = *device;
  const std::lock_guard lock(chain_mutex);
  chain()[key_of(*device)] = next;
  return VK_SUCCESS;
}

void destroy_device(VkDevice device, const VkAllocationCallbacks* callbacks) {
  if (device == VK_NULL_HANDLE) return;
  void* const key = key_of(device);
  next_function<PFN_vkDestroyDevice>(device, "vkDestroyDevice")(device, callbacks);
  const std::lock_guard lock(chain_mutex);
  chain().erase(key);
}

PFN_vkVoidFunction instance_proc(VkInstance instance, const char* name);
PFN_vkVoidFunction device_proc(VkDevice device, const char* name);

template <typename Function>
PFN_vkVoidFunction as_void(Function function) {
  return reinterpret_cast<PFN_vkVoidFunction>(function);
}

template <Name kName, typename Function>
std::pair<const std::string, PFN_vkVoidFunction> counted() {
  return {kName.value, as_void(&Counted<kName, Function>::call)};
}

const std::map<std::string, PFN_vkVoidFunction>& instance_functions() {
  static const std::map<std::string, PFN_vkVoidFunction> functions{
      {"vkGetInstanceProcAddr", as_void(instance_proc)},
      {"vkCreateInstance", as_void(create_instance)},
      {"vkDestroyInstance", as_void(destroy_instance)},
      {"vkCreateDevice", as_void(create_device)},
      {"vkGetPhysicalDeviceMemoryProperties", as_void(memory_properties)},
      {"vkGetPhysicalDeviceMemoryProperties2", as_void(memory_properties2)},
      {"vkGetPhysicalDeviceProperties", as_void(device_properties)},
      {"vkGetPhysicalDeviceProperties2", as_void(device_properties2)},
      {"vkGetPhysicalDeviceFeatures2", as_void(device_features2)},
      counted<"vkEnumeratePhysicalDevices", PFN_vkEnumeratePhysicalDevices>(),
      counted<"vkEnumerateDeviceExtensionProperties", PFN_vkEnumerateDeviceExtensionProperties>(),
  };
  return functions;
}

const std::map<std::string, PFN_vkVoidFunction>& device_functions() {
  static const std::map<std::string, PFN_vkVoidFunction> functions{
      {"vkGetDeviceProcAddr", as_void(device_proc)},
      {"vkDestroyDevice", as_void(destroy_device)},
      {"vkAllocateMemory", as_void(allocate_memory)},
      {"vkFreeMemory", as_void(free_memory)},
      counted<"vkAllocateCommandBuffers", PFN_vkAllocateCommandBuffers>(),
      counted<"vkAllocateDescriptorSets", PFN_vkAllocateDescriptorSets>(),
      counted<"vkBeginCommandBuffer", PFN_vkBeginCommandBuffer>(),
      counted<"vkBindBufferMemory", PFN_vkBindBufferMemory>(),
      counted<"vkBindImageMemory", PFN_vkBindImageMemory>(),
      counted<"vkCreateBuffer", PFN_vkCreateBuffer>(),
      counted<"vkCreateCommandPool", PFN_vkCreateCommandPool>(),
      counted<"vkCreateComputePipelines", PFN_vkCreateComputePipelines>(),
      counted<"vkCreateDescriptorPool", PFN_vkCreateDescriptorPool>(),
      counted<"vkCreateDescriptorSetLayout", PFN_vkCreateDescriptorSetLayout>(),
      counted<"vkCreateFence", PFN_vkCreateFence>(),
      counted<"vkCreateGraphicsPipelines", PFN_vkCreateGraphicsPipelines>(),
      counted<"vkCreateImage", PFN_vkCreateImage>(),
      counted<"vkCreateImageView", PFN_vkCreateImageView>(),
      {"vkCreatePipelineCache", as_void(create_pipeline_cache)},
      counted<"vkGetPipelineCacheData", PFN_vkGetPipelineCacheData>(),
      counted<"vkCreatePipelineLayout", PFN_vkCreatePipelineLayout>(),
      counted<"vkCreateQueryPool", PFN_vkCreateQueryPool>(),
      counted<"vkCreateSampler", PFN_vkCreateSampler>(),
      counted<"vkCreateShaderModule", PFN_vkCreateShaderModule>(),
      counted<"vkDeviceWaitIdle", PFN_vkDeviceWaitIdle>(),
      counted<"vkEndCommandBuffer", PFN_vkEndCommandBuffer>(),
      counted<"vkGetQueryPoolResults", PFN_vkGetQueryPoolResults>(),
      counted<"vkMapMemory", PFN_vkMapMemory>(),
      counted<"vkQueueSubmit", PFN_vkQueueSubmit>(),
      counted<"vkQueueSubmit2", PFN_vkQueueSubmit2>(),
      counted<"vkQueueWaitIdle", PFN_vkQueueWaitIdle>(),
      counted<"vkResetCommandPool", PFN_vkResetCommandPool>(),
      counted<"vkResetFences", PFN_vkResetFences>(),
      counted<"vkWaitForFences", PFN_vkWaitForFences>(),
  };
  return functions;
}

PFN_vkVoidFunction device_proc(VkDevice device, const char* name) {
  const auto found = device_functions().find(name);
  const Next next = next_of(device);
  const PFN_vkVoidFunction below = next.device_proc(next.device, name);
  // What the device does not have, it does not have with this layer either.
  return found != device_functions().end() && below != nullptr ? found->second : below;
}

PFN_vkVoidFunction instance_proc(VkInstance instance, const char* name) {
  for (const auto* functions : {&instance_functions(), &device_functions()}) {
    const auto found = functions->find(name);
    if (found != functions->end()) return found->second;
  }
  if (instance == VK_NULL_HANDLE) return nullptr;
  const Next next = next_of(instance);
  return next.instance_proc(next.instance, name);
}

}  // namespace
}  // namespace lightloom::faults

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
  constexpr uint32_t kInterface = 2;
  if (versions->loaderLayerInterfaceVersion < kInterface) return VK_ERROR_INITIALIZATION_FAILED;
  versions->loaderLayerInterfaceVersion = kInterface;
  versions->pfnGetInstanceProcAddr = lightloom::faults::instance_proc;
  versions->pfnGetDeviceProcAddr = lightloom::faults::device_proc;
  versions->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
