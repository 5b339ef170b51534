#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

#include "framework/base/error.hpp"

namespace lightloom::gpu {

/// "VK_ERROR_DEVICE_LOST"; an unknown value gives its number.
[[nodiscard]] std::string result_name(VkResult result);

/// The device gave up, or does not come to an end: nothing more can be asked of it.
class DeviceLost : public Error {
 public:
  explicit DeviceLost(const std::string& sentence, std::string hint = {})
      : Error(ExitCode::run_failed, sentence,
              hint.empty() ? "the device or its driver gave up; run again with --validate, or on another device with "
                             "--device"
                           : std::move(hint)) {}
};

/// The device or the machine has no memory left for something.
class OutOfMemory : public Error {
 public:
  explicit OutOfMemory(const std::string& sentence, const std::string& hint = "choose a smaller size or resolution")
      : Error(ExitCode::run_failed, sentence, hint) {}
};

/// Throws Error(run_failed) that names the call and the result, unless `result` is a success code; DeviceLost or
/// OutOfMemory where the result says so.
/// @param what the call, e.g. "vkCreateImage (temporal.radiance)"
void check(VkResult result, std::string_view what);

/// The same for what is asked of drivers before there is a device: Error(no_device).
void require_driver(VkResult result, std::string_view what);

}  // namespace lightloom::gpu
