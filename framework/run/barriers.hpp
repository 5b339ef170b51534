#pragma once

#include <vulkan/vulkan_core.h>

#include <span>

#include "framework/graph/plan.hpp"

namespace lightloom::run {

/// A memory dependency between all earlier `from` accesses and all later `to` accesses, of whatever image.
struct Dependency {
  Access from = Access::none;
  Access to = Access::none;
  bool operator==(const Dependency&) const = default;
};

/// Records dependencies by one call; nothing for none. Layouts never change (access.hpp), so dependencies on all memory
/// say the same as ones on single images, at a lower cost; those with the same `from` join.
void record_dependencies(VkCommandBuffer commands, std::span<const Dependency> dependencies);

/// Records the barriers of one point of a plan by one call. Those that take memory over are left out: they discard what
/// their images hold, so they are `takeovers` (ValueImages::takeovers).
void record_barriers(VkCommandBuffer commands, std::span<const Barrier> barriers,
                     std::span<const VkImageMemoryBarrier2> takeovers = {});

}  // namespace lightloom::run
