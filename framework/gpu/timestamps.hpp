#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framework/gpu/device.hpp"

namespace lightloom::gpu {

/// A set of timestamp queries of the device's queue.
class TimestampPool {
 public:
  TimestampPool(const Device& device, uint32_t count);

  /// False on a device without timestamps: `reset` and `write` then do nothing, and there are no results.
  [[nodiscard]] bool available() const { return pool_.get() != VK_NULL_HANDLE; }
  [[nodiscard]] uint32_t count() const { return count_; }
  /// Must be recorded before the first `write` of a submission, outside of rendering.
  void reset(VkCommandBuffer commands) const;
  /// Time at which all earlier commands are done.
  void write(VkCommandBuffer commands, uint32_t index) const;
  /// Times of queries 0..written-1 since query 0 [ns]; empty if not available. Call after the submission is done; those
  /// queries must all have been written.
  [[nodiscard]] std::vector<double> nanoseconds(uint32_t written) const;
  /// Which of the queries 0..count-1 were written since the times were read last, of a device that was lost; nothing
  /// where it does not tell.
  [[nodiscard]] std::optional<std::vector<bool>> written(uint32_t count) const;

 private:
  const Device& device_;
  uint32_t count_ = 0;
  mutable uint64_t newest_ = 0;  ///< ticks of those that were read
  QueryPoolHandle pool_;
};

}  // namespace lightloom::gpu
