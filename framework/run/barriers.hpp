#pragma once

#include <vulkan/vulkan_core.h>

#include <span>

#include "framework/graph/plan.hpp"

namespace lightloom::run {

/// Records the barriers of one point of a plan as a single memory barrier. Layouts never change (access.hpp), so one
/// global dependency with the union of their scopes says the same as one per image, at a lower cost. Leaves out those
/// that take memory over, which are ValueImages::record_takeovers's.
void record_barriers(VkCommandBuffer commands, std::span<const Barrier> barriers);

}  // namespace lightloom::run
