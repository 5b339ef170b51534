#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

namespace lightloom::gpu {

/// "VK_ERROR_DEVICE_LOST"; an unknown value gives its number.
[[nodiscard]] std::string result_name(VkResult result);

/// Throws Error(run_failed) that names the call and the result, unless `result` is a success code.
/// @param what the call, e.g. "vkCreateImage (temporal.radiance)"
void check(VkResult result, std::string_view what);

}  // namespace lightloom::gpu
