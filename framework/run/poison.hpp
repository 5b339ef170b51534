#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// What stands where nobody wrote. Two runs that differ in this alone have the same bits unless a pass reads it.
enum class PoisonTone : uint8_t {
  nan,  ///< floats: a NaN with a payload that no computation makes; others: one large number
  /// Floats: a finite number, negative in frames of even count, positive in the others; others: a small and a large
  /// one.
  number,
};

/// Raw bits of each channel of a poisoned texel. Integers are small enough to be no harm as an index or as a count, and
/// depths lie between 0 and 1, as Vulkan demands.
[[nodiscard]] uint32_t poison_bits(Format format, PoisonTone tone, uint64_t frame_count);

/// Fills images with poison: all at the start that the plan does not clear; each value before its pass writes it, and
/// again after its last use in a frame. Not what a frame keeps: constants, layers of histories that are still to be
/// read, persistent values after the first frame, and hoisted values once they are written.
class Poison {
 public:
  Poison(const gpu::Device& device, const Plan& plan, PoisonTone tone);

  [[nodiscard]] PoisonTone tone() const { return tone_; }
  /// Before the first frame, with all images in GENERAL that have memory of their own.
  void record_initialisation(VkCommandBuffer commands, const ValueImages& images) const;
  /// Behind the barriers of a step, before its pass.
  void record_before(VkCommandBuffer commands, const GraphPass& pass, const ValueImages& images,
                     uint64_t frame_count) const;
  /// Behind the step's pass and observations.
  void record_after(VkCommandBuffer commands, const GraphPass& pass, const ValueImages& images,
                    uint64_t frame_count) const;

 private:
  void record_fill(VkCommandBuffer commands, ValueId value, const ValueLayer& layer, uint64_t frame_count) const;

  const Graph& graph_;  ///< of the plan
  PoisonTone tone_;
  std::vector<bool> cleared_;                           ///< by value: the plan's prologue clears it
  std::vector<bool> shares_;                            ///< by value: it has its memory for a part of the frame only
  std::map<uint32_t, std::vector<ValueId>> last_used_;  ///< by index of the pass that uses them last in a frame
  gpu::Buffer pattern_;
};

}  // namespace lightloom::run
