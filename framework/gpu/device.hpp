#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/gpu/handle.hpp"
#include "framework/gpu/instance.hpp"
#include "framework/gpu/memory_ledger.hpp"

namespace lightloom::gpu {

struct DeviceOptions {
  /// Part of the device's name, in any case, or its index in `list_devices` ("0", "1", …). Empty: the environment
  /// variable LIGHTLOOM_DEVICE; where that is empty too, the first usable one of the kinds discrete GPU, integrated
  /// GPU, virtual GPU, CPU.
  std::string name;
  bool validate = false;  ///< validation layer with synchronization validation
};

enum class DeviceType : uint8_t { discrete_gpu, integrated_gpu, virtual_gpu, cpu, other };
[[nodiscard]] std::string to_string(DeviceType type);  ///< "discrete GPU"

/// Whether shaders of a device can ask what a ray meets, and by which limits.
struct RayQuerySupport {
  bool available = false;          ///< VK_KHR_acceleration_structure and VK_KHR_ray_query with what these need
  std::string missing;             ///< what is not there, in words; empty if available
  uint32_t scratch_alignment = 1;  ///< of the memory in which structures are built [bytes]
  uint64_t most_primitives = 0;    ///< triangles of one bottom-level structure
};

/// What is known of a device without opening it.
struct DeviceInfo {
  std::string name;
  DeviceType type = DeviceType::other;
  std::string driver;       ///< "llvmpipe"
  std::string driver_info;  ///< "Mesa 22.3.6 (LLVM 15.0.6)"
  uint32_t api_version = 0;
  uint32_t vendor_id = 0;
  uint32_t device_id = 0;
  std::array<uint8_t, VK_UUID_SIZE> uuid{};
  VkPhysicalDeviceLimits limits{};
  uint64_t max_allocation_bytes = 0;  ///< of one allocation
  bool has_memory_budget = false;     ///< VK_EXT_memory_budget
  RayQuerySupport ray_query;
  [[nodiscard]] std::string api_version_text() const;  ///< "1.3.230"
  [[nodiscard]] std::string uuid_text() const;         ///< hexadecimal, 32 digits
};

struct DeviceSummary {
  DeviceInfo info;
  bool usable = false;
  std::string missing;  ///< what keeps it from being usable, in words; empty if usable
};

/// Every device of this machine, in the loader's order; empty if there is no driver.
[[nodiscard]] std::vector<DeviceSummary> list_devices();

/// A Vulkan 1.3 device with one queue that does graphics, compute and transfer; ray queries are switched on where it
/// has them.
class Device {
 public:
  /// Throws Error(no_device) that names what is missing, or lists the devices there if `options.name` fits none.
  explicit Device(const DeviceOptions& options = {});
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] VkDevice get() const { return device_; }
  [[nodiscard]] DeviceRef ref() const { return {device_, &hangs_}; }
  [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] uint32_t queue_family() const { return queue_family_; }
  /// It was given up, see run_commands.
  [[nodiscard]] bool hangs() const { return hangs_; }
  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  /// Bits of a timestamp that mean something; 0: the queue has no timestamps.
  [[nodiscard]] uint32_t timestamp_bits() const { return timestamp_bits_; }
  [[nodiscard]] const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }

  /// Of what is allocated from it (gpu/memory.hpp).
  [[nodiscard]] MemoryLedger& memory_ledger() const { return *ledger_; }

  [[nodiscard]] bool validating() const { return instance_.validating(); }
  /// Warnings and errors of the validation layer so far (ValidationLog).
  [[nodiscard]] std::vector<ValidationMessage> validation_messages() const { return instance_.log().messages(); }
  void clear_validation_messages() { instance_.log().clear(); }

  /// Records one command buffer, submits it and waits until it is done. Not reentrant, one thread at a time.
  /// Throws DeviceLost if the device is lost, or does not finish within 120 s; the environment variable
  /// LIGHTLOOM_DEVICE_TIMEOUT gives other seconds, 0 for no limit, which is what a CPU device has. A device that was
  /// given up is left as it is: neither it nor anything of it is freed before the process ends.
  void run_commands(const std::function<void(VkCommandBuffer)>& record);
  /// The two halves of run_commands, for who is still to decide what follows (CommandSession): begins the one command
  /// buffer, forgetting what an unfinished recording left in it …
  [[nodiscard]] VkCommandBuffer begin_commands();
  /// … and ends it, submits it and waits until it is done. Errors as above.
  void finish_commands();
  /// finish_commands in two halves, for who has something else to do meanwhile: ends and submits; what the commands use
  /// must live until …
  void submit_commands();
  /// … they are done: waits for what was submitted, if anything. begin_commands does so by itself.
  void wait_commands();

  /// Name that validation messages show; without effect unless validating.
  void set_name(VkObjectType type, uint64_t object, const std::string& name) const;

 private:
  void create_device(bool validate);
  void create_commands();

  std::unique_ptr<MemoryLedger> ledger_ = std::make_unique<MemoryLedger>();
  Instance instance_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  DeviceInfo info_;
  VkPhysicalDeviceMemoryProperties memory_{};
  uint32_t queue_family_ = 0;
  uint32_t timestamp_bits_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint64_t patience_ = 0;  ///< for one submission [s]; 0: no limit
  bool lost_ = false;
  bool hangs_ = false;    ///< the last submission was given up: it may run still
  bool running_ = false;  ///< the command buffer was submitted and not yet waited for
  PFN_vkSetDebugUtilsObjectNameEXT set_object_name_ = nullptr;
  CommandPoolHandle command_pool_;
  VkCommandBuffer command_buffer_ = VK_NULL_HANDLE;
  FenceHandle fence_;
};

}  // namespace lightloom::gpu
