#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "framework/graph/format.hpp"

namespace lightloom::gpu {

[[nodiscard]] VkFormat vulkan_format(Format format);

/// Bytes of one texel of the formats that the framework uses: those of `Format`, and R8G8B8A8_SRGB.
/// Throws Error(run_failed) for any other.
[[nodiscard]] uint32_t texel_bytes(VkFormat format);

[[nodiscard]] VkImageAspectFlags aspect_of(VkFormat format);
/// What a shader sees on reading: unsigned_integer for the UINT formats.
[[nodiscard]] NumericClass numeric_class(VkFormat format);

}  // namespace lightloom::gpu
