#pragma once

#include <map>
#include <utility>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// Read-back buffers for every copy of a plan.
class Readback {
 public:
  /// With `single_texels` only one texel of each value is copied, and the buffers are no larger.
  Readback(const gpu::Device& device, const Plan& plan, bool single_texels = false);

  /// Which texel, by value id; the first one before.
  void look_at(const std::vector<VkOffset3D>& texels) { texels_ = texels; }

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

  [[nodiscard]] gpu::ImageRegion region(ValueId value, const ValueLayer& layer) const;

  bool single_texels_;
  std::vector<VkOffset3D> texels_;
  std::map<Key, gpu::Buffer> buffers_;
  std::map<Key, ImageDesc> descs_;
};

}  // namespace lightloom::run
