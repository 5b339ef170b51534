#pragma once

#include "framework/gpu/device.hpp"

namespace lightloom::gpu {

/// Commands that are recorded one after another and submitted in pieces, so that the host can work between two pieces
/// on what the device has done. Barriers reach over the pieces, since all go to one queue. One at a time for a device.
class CommandSession {
 public:
  explicit CommandSession(Device& device) : device_(device) {}

  /// The command buffer that takes what comes next; valid until `submit`.
  [[nodiscard]] VkCommandBuffer get() {
    if (commands_ == VK_NULL_HANDLE) commands_ = device_.begin_commands();
    return commands_;
  }
  /// Submits what was recorded since the last time, if anything, and waits until it is done.
  void submit() {
    if (commands_ == VK_NULL_HANDLE) return;
    commands_ = VK_NULL_HANDLE;
    device_.finish_commands();
  }
  /// Submits it and returns at once; Device::wait_commands waits.
  void start() {
    if (commands_ == VK_NULL_HANDLE) return;
    commands_ = VK_NULL_HANDLE;
    device_.submit_commands();
  }

 private:
  Device& device_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace lightloom::gpu
