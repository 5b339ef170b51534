#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace lightloom::gpu {

/// A warning or an error of the validation layers.
struct ValidationMessage {
  bool error = false;
  std::string id;    ///< e.g. "SYNC-HAZARD-READ-AFTER-WRITE"
  std::string text;  ///< whole text of the layer
};

/// Collects messages from any thread: the first kMostMessages, and then one that says how many more there were, so that
/// a long run cannot fill memory.
class ValidationLog {
 public:
  static constexpr size_t kMostMessages = 256;

  void add(ValidationMessage message);
  void clear();
  [[nodiscard]] std::vector<ValidationMessage> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<ValidationMessage> messages_;
  uint64_t left_out_ = 0;
  bool error_left_out_ = false;
};

/// A Vulkan 1.3 instance without any window-system extension; with validation if asked.
class Instance {
 public:
  /// Throws Error(no_device): no Vulkan driver, or `validate` without the validation layer.
  explicit Instance(bool validate);
  ~Instance();
  /// Leaves it as it is, with all that it made, until the process ends.
  void abandon();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance get() const { return instance_; }
  [[nodiscard]] bool validating() const { return messenger_ != VK_NULL_HANDLE; }
  [[nodiscard]] ValidationLog& log() { return *log_; }
  [[nodiscard]] const ValidationLog& log() const { return *log_; }
  [[nodiscard]] std::vector<VkPhysicalDevice> physical_devices() const;

 private:
  std::unique_ptr<ValidationLog> log_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace lightloom::gpu
