#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <vector>

namespace lightloom {

/// The bits that access.cpp uses, as Vulkan names them without prefix and suffix: "COMPUTE_SHADER",
/// "SHADER_SAMPLED_READ". Throws std::logic_error for others.
[[nodiscard]] std::vector<std::string> stage_names(VkPipelineStageFlags2 stages);
[[nodiscard]] std::vector<std::string> access_names(VkAccessFlags2 access);

}  // namespace lightloom
