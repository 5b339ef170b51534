#pragma once

#include <map>
#include <utility>

#include "framework/gpu/buffer.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/scene_memo.hpp"
#include "framework/run/value_images.hpp"
#include "framework/scene/frame_scene.hpp"

namespace lightloom::run {

/// What a host pass sees of a frame besides its ports.
struct HostFrame {
  const scene::FrameScene* scene = nullptr;
  SceneMemo* memo = nullptr;
};

/// The buffers through which a plan's host passes (PassType::host) exchange images with the device.
class HostPasses {
 public:
  HostPasses(const gpu::Device& device, const Plan& plan);

  /// Records the copies of the connected inputs, and makes them visible to the host. The barriers before are the
  /// plan's.
  void record_inputs(VkCommandBuffer commands, const GraphPass& pass, const ValueImages& images,
                     uint64_t frame_count) const;
  /// Calls the pass, once the device is done with the inputs. Returns how long it computed [ms]. Throws what it throws,
  /// and Error(run_failed) that names the pass if it asks for what its type does not declare.
  double run(const Graph& graph, const GraphPass& pass, const HostFrame& frame) const;
  /// Records the copies of what it wrote, where anything reads that, into the images.
  void record_outputs(VkCommandBuffer commands, const Graph& graph, const GraphPass& pass, const ValueImages& images,
                      uint64_t frame_count) const;

 private:
  std::map<std::pair<ValueId, uint32_t>, gpu::Buffer> inputs_;  ///< by value and age
  std::map<ValueId, gpu::Buffer> outputs_;                      ///< of those that are read
};

}  // namespace lightloom::run
