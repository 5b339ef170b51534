#include "framework/gpu/instance.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                               VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  static_cast<ValidationLog*>(log)->add({.error = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                                         .id = data->pMessageIdName != nullptr ? data->pMessageIdName : "",
                                         .text = data->pMessage != nullptr ? data->pMessage : ""});
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Messages of the type GENERAL come from the loader (other drivers' manifests), not from the use of Vulkan.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = collect_message;
  info.pUserData = &log;
  return info;
}

bool has_extension(const char* layer, const char* name) {
  uint32_t count = 0;
  if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  if (vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data()) < 0) return false;
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const auto& extension) { return std::strcmp(extension.extensionName, name) == 0; });
}

void require_validation_layer() {
  uint32_t count = 0;
  require_driver(vkEnumerateInstanceLayerProperties(&count, nullptr), "asking for the layers");
  std::vector<VkLayerProperties> layers(count);
  require_driver(vkEnumerateInstanceLayerProperties(&count, layers.data()), "asking for the layers");
  const bool found = std::any_of(layers.begin(), layers.end(),
                                 [](const auto& layer) { return std::strcmp(layer.layerName, kValidationLayer) == 0; });
  if (found) return;
  throw Error(ExitCode::no_device,
              std::string("validation was asked for, but the layer ") + kValidationLayer + " is not installed",
              "install the package vulkan-validationlayers, or run without --validate");
}

VkInstance create_instance(bool validate, ValidationLog& log) {
  std::vector<const char*> extensions;
  std::vector<const char*> layers;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  if (has_extension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "lightloom";
  application.apiVersion = VK_API_VERSION_1_3;
  info.pApplicationInfo = &application;

  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(log);
  const std::array<VkValidationFeatureEnableEXT, 1> enabled{
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = static_cast<uint32_t>(enabled.size());
  features.pEnabledValidationFeatures = enabled.data();
  if (validate) {
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    features.pNext = &messenger;
    info.pNext = &features;
  }
  info.enabledLayerCount = static_cast<uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();

  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result != VK_SUCCESS) {
    throw Error(ExitCode::no_device, "no Vulkan driver answers: vkCreateInstance gave " + result_name(result),
                "install a driver; the package mesa-vulkan-drivers renders on the CPU");
  }
  return instance;
}

}  // namespace

void ValidationLog::add(ValidationMessage message) {
  const std::lock_guard lock(mutex_);
  if (messages_.size() < kMostMessages) {
    messages_.push_back(std::move(message));
    return;
  }
  ++left_out_;
  error_left_out_ = error_left_out_ || message.error;
}

void ValidationLog::clear() {
  const std::lock_guard lock(mutex_);
  messages_.clear();
  left_out_ = 0;
  error_left_out_ = false;
}

std::vector<ValidationMessage> ValidationLog::messages() const {
  const std::lock_guard lock(mutex_);
  std::vector<ValidationMessage> messages = messages_;
  if (left_out_ > 0)
    messages.push_back({error_left_out_, "more", "and " + std::to_string(left_out_) + " more messages, not kept"});
  return messages;
}

Instance::Instance(bool validate) : log_(std::make_unique<ValidationLog>()) {
  if (validate) require_validation_layer();
  instance_ = create_instance(validate, *log_);
  if (!validate) return;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(*log_);
  if (create == nullptr || create(instance_, &info, nullptr, &messenger_) != VK_SUCCESS) {
    vkDestroyInstance(instance_, nullptr);
    throw Error(ExitCode::no_device, "the validation layer gives no access to its messages");
  }
}

void Instance::abandon() {
  instance_ = VK_NULL_HANDLE;
  static_cast<void>(log_.release());  // the messenger still writes to it
}

Instance::~Instance() {
  if (instance_ == VK_NULL_HANDLE) return;
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
  uint32_t count = 0;
  // VK_ERROR_INITIALIZATION_FAILED: a loader with drivers none of which finds a device.
  const VkResult counted = vkEnumeratePhysicalDevices(instance_, &count, nullptr);
  if (counted == VK_ERROR_INITIALIZATION_FAILED) return {};
  require_driver(counted, "asking the drivers for their devices");
  std::vector<VkPhysicalDevice> devices(count);
  require_driver(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "asking the drivers for their devices");
  devices.resize(count);
  return devices;
}

}  // namespace lightloom::gpu
