#include "framework/run/barriers.hpp"

#include <array>
#include <cstddef>

namespace lightloom::run {
namespace {

/// One VkMemoryBarrier2 for each kind of access that is waited for, so that no dependency arises which none of them
/// demands.
class Batch {
 public:
  void add(Access from, Access to) {
    const AccessInfo& source = access_info(from);
    const AccessInfo& target = access_info(to);
    VkMemoryBarrier2& barrier = find(source);
    barrier.dstStageMask |= target.stages;
    barrier.dstAccessMask |= target.access;
  }

  void record(VkCommandBuffer commands, std::span<const VkImageMemoryBarrier2> images) const {
    if (count_ == 0 && images.empty()) return;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = count_;
    dependency.pMemoryBarriers = barriers_.data();
    dependency.imageMemoryBarrierCount = static_cast<uint32_t>(images.size());
    dependency.pImageMemoryBarriers = images.data();
    vkCmdPipelineBarrier2(commands, &dependency);
  }

 private:
  VkMemoryBarrier2& find(const AccessInfo& source) {
    for (uint32_t i = 0; i < count_; ++i)
      if (barriers_[i].srcStageMask == source.stages && barriers_[i].srcAccessMask == source.access)
        return barriers_[i];
    VkMemoryBarrier2& barrier = barriers_.at(count_++);
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = source.stages;
    barrier.srcAccessMask = source.access;
    return barrier;
  }

  std::array<VkMemoryBarrier2, static_cast<std::size_t>(Access::anything) + 1> barriers_{};
  uint32_t count_ = 0;
};

}  // namespace

void record_dependencies(VkCommandBuffer commands, std::span<const Dependency> dependencies) {
  Batch batch;
  for (const Dependency& dependency : dependencies) batch.add(dependency.from, dependency.to);
  batch.record(commands, {});
}

void record_barriers(VkCommandBuffer commands, std::span<const Barrier> barriers,
                     std::span<const VkImageMemoryBarrier2> takeovers) {
  Batch batch;
  for (const Barrier& barrier : barriers)
    if (!barrier.takes_over) batch.add(barrier.from, barrier.to);
  batch.record(commands, takeovers);
}

}  // namespace lightloom::run
