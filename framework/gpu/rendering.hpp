#pragma once

#include <vulkan/vulkan_core.h>

#include <optional>
#include <span>

#include "framework/gpu/image.hpp"

namespace lightloom::gpu {

/// An attachment in layout GENERAL.
struct ColorTarget {
  ImageView view;
  std::optional<VkClearColorValue> clear;  ///< none: keep what is there
};
struct DepthTarget {
  ImageView view;
  std::optional<float> clear;
};

/// Begins dynamic rendering and sets viewport and scissor to the whole `extent`; end with vkCmdEndRendering.
void begin_rendering(VkCommandBuffer commands, VkExtent2D extent, std::span<const ColorTarget> colors,
                     const std::optional<DepthTarget>& depth);

}  // namespace lightloom::gpu
