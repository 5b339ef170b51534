#pragma once

#include <map>
#include <utility>

#include "framework/gpu/buffer.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// Read-back buffers for every copy of a plan.
class Readback {
 public:
  Readback(const gpu::Device& device, const Plan& plan);

  /// Records the copy; its barriers are the plan's.
  void record(VkCommandBuffer commands, const Observation& observation, const ValueImages& images,
              uint64_t frame_count) const;
  /// Makes the copies visible to the host; last command of a submission.
  static void record_end(VkCommandBuffer commands);
  /// The texels of the last frame; valid once the device is done.
  [[nodiscard]] image::HostImage fetch(ValueId value, uint32_t age) const;

 private:
  using Key = std::pair<ValueId, uint32_t>;
  void add(const gpu::Device& device, const Graph& graph, const Observation& observation);

  std::map<Key, gpu::Buffer> buffers_;
  std::map<Key, ImageDesc> descs_;
};

}  // namespace lightloom::run
