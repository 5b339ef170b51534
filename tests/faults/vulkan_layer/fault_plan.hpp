#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lightloom::faults {

/// What the layer does to calls of one function, read from the environment variable LIGHTLOOM_FAULTS; entries are
/// parted by ';':
/// - fail=FUNCTION:N:RESULT: the N-th call, from 1, gives RESULT (e.g. VK_ERROR_DEVICE_LOST); "N+": and every later one
/// - delay=FUNCTION:N:MS: the N-th call is held up for so long [ms]; "N+" as above
/// - heap=BYTES: size and budget of every memory heap, kept to
/// - api=1.2: version that devices tell
/// - type=discrete: type of device that devices tell, instead of CPU
/// - hide=FEATURE: feature that devices do not have
/// - mark=FILE: is made when a failure takes place, so that another part of the test can wait for that
/// - log=FILE: one line for each counted function, "FUNCTION calls", for the bytes that pipeline caches began with,
///   "pipeline_cache_bytes bytes", and for each entry that struck, "struck ENTRY"; written when the instance goes
struct CallRule {
  std::string function;
  uint64_t first = 0;  ///< call, from 1
  bool onwards = false;
  VkResult result = VK_SUCCESS;  ///< VK_SUCCESS: no failure
  uint32_t milliseconds = 0;
  std::string text;
};

struct Faults {
  std::vector<CallRule> calls;
  std::optional<uint64_t> heap_bytes;
  std::optional<uint32_t> api_version;
  bool discrete = false;
  std::set<std::string> hidden;
  std::string mark;
  std::string log;
};

/// Throws std::invalid_argument that names the entry.
[[nodiscard]] Faults parse_faults(const std::string& text);

/// Counts calls of all threads and decides which fail.
class FaultPlan {
 public:
  /// Reads LIGHTLOOM_FAULTS; counts start anew where it changed since the last time.
  void load();
  /// Counts this call, waits where a delay is due, and tells the failure that is due.
  [[nodiscard]] std::optional<VkResult> on_call(const std::string& function);
  /// Adds to a number of the log that is no count of calls.
  void add(const std::string& name, uint64_t number);
  [[nodiscard]] Faults faults() const;
  void write_log() const;

  /// The budget of device memory: false where `bytes` more would go beyond the cap.
  [[nodiscard]] bool take(VkDeviceMemory memory, uint64_t bytes, bool only_ask);
  void give_back(VkDeviceMemory memory);
  [[nodiscard]] uint64_t taken() const;

 private:
  mutable std::mutex mutex_;
  std::string text_;
  Faults faults_;
  std::map<std::string, uint64_t> counts_;
  std::set<std::string> struck_;
  std::map<VkDeviceMemory, uint64_t> memory_;
  uint64_t taken_ = 0;
};

[[nodiscard]] FaultPlan& fault_plan();

}  // namespace lightloom::faults
