#include "framework/run/barriers.hpp"

#include <algorithm>

namespace lightloom::run {

void record_barriers(VkCommandBuffer commands, std::span<const Barrier> barriers) {
  const auto everywhere = [](const Barrier& barrier) { return !barrier.takes_over; };
  if (std::none_of(barriers.begin(), barriers.end(), everywhere)) return;
  VkMemoryBarrier2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  for (const Barrier& barrier : barriers) {
    if (!everywhere(barrier)) continue;
    const AccessInfo& from = access_info(barrier.from);
    const AccessInfo& to = access_info(barrier.to);
    memory.srcStageMask |= from.stages;
    memory.dstStageMask |= to.stages;
    memory.srcAccessMask |= from.access;
    memory.dstAccessMask |= to.access;
  }
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &memory;
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace lightloom::run
