#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// The host's copies of what one frame showed of its values.
class FrameCopies {
 public:
  /// The texels of a value that the frame's wants cover, once the device is done with the frame. From any thread.
  [[nodiscard]] image::HostImage fetch(ValueId value, uint32_t age) const;

 private:
  friend class Readback;
  using Key = std::pair<ValueId, uint32_t>;  ///< value and age
  struct Copy {
    gpu::Buffer buffer;
    ImageDesc desc;
  };
  std::map<Key, Copy> copies_;
  std::set<Key> wanted_;
};

/// Read-back buffers for the values that a plan observes: a set of them for each frame whose copies someone holds, so
/// that one frame's can be fetched while the device fills the next one's. A set that is let go serves again.
class Readback {
 public:
  /// With `single_texels` only one texel of each value is copied, and the buffers are no larger.
  Readback(const gpu::Device& device, const Plan& plan, bool single_texels = false);

  /// Which texel, by value id; the first one before.
  void look_at(const std::vector<VkOffset3D>& texels) { texels_ = texels; }

  /// A set for the next frame, of which so much is wanted. May be let go on any thread, and after this object, but not
  /// after the device.
  [[nodiscard]] std::shared_ptr<const FrameCopies> acquire(const FrameWants& wants);
  /// Records the copy of an observed value, if the frame wants it; its barriers are the plan's.
  void record(VkCommandBuffer commands, const Observation& observation, const ValueImages& images, uint64_t frame_count,
              const FrameCopies& copies) const;
  /// Makes the copies visible to the host; last command of a submission.
  static void record_end(VkCommandBuffer commands);
  /// Sets made so far.
  [[nodiscard]] size_t set_count() const { return set_count_; }

 private:
  using Key = FrameCopies::Key;
  struct Pool {
    std::mutex mutex;
    std::vector<std::unique_ptr<FrameCopies>> free;
  };
  [[nodiscard]] bool wants_copy(const Key& key, const FrameWants& wants) const;
  [[nodiscard]] gpu::ImageRegion region(ValueId value, const ValueLayer& layer) const;
  [[nodiscard]] FrameCopies::Copy make_copy(const Value& value) const;

  const gpu::Device& device_;
  bool single_texels_;
  std::vector<VkOffset3D> texels_;
  std::map<Key, Value> observed_;
  std::set<Key> outputs_;
  std::set<Key> captures_;
  std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();  ///< shared with the sets that are held
  size_t set_count_ = 0;
};

}  // namespace lightloom::run
