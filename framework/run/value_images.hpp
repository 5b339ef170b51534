#pragma once

#include <span>
#include <vector>

#include "framework/gpu/image.hpp"
#include "framework/graph/plan.hpp"
#include "framework/graph/share_memory.hpp"

namespace lightloom::run {

/// One layer of a value: an image and the array layer in it.
struct ValueLayer {
  const gpu::Image* image = nullptr;
  uint32_t layer = 0;
};

/// The images behind a plan's values. A 2D history ring is one image with a layer per age, so that shaders can index
/// it; a 3D ring is one image per layer, since volumes have no layers.
class ValueImages {
 public:
  /// With `share`, values that are not live at the same time share memory, and the plan gets the barriers which that
  /// demands. Throws Error(run_failed) when the values are too large for the device (require_room), before it allocates
  /// any.
  ValueImages(const gpu::Device& device, Plan& plan, bool share);

  /// The layer that holds `value` as it was `age` frames before frame number `count` (frames counted since the start).
  [[nodiscard]] ValueLayer layer(ValueId value, uint32_t age, uint64_t count) const;
  /// Layer number of age 0.
  [[nodiscard]] uint32_t newest(ValueId value, uint64_t count) const;
  [[nodiscard]] uint32_t ring(ValueId value) const;
  [[nodiscard]] gpu::ImageView view(ValueId value, uint32_t age, uint64_t count) const;
  /// The whole ring of a 2D value.
  [[nodiscard]] gpu::ImageView array_view(ValueId value) const;

  /// Brings every image that has its memory to itself into GENERAL and fills it with zeros, so that nothing can depend
  /// on what the memory held.
  void record_initialisation(VkCommandBuffer commands) const;
  /// Those of `barriers` that take memory over: they bring their images into GENERAL behind the uses they wait for.
  [[nodiscard]] std::vector<VkImageMemoryBarrier2> takeovers(std::span<const Barrier> barriers) const;
  /// Fills every layer of a value.
  void record_clear(VkCommandBuffer commands, const Clear& clear) const;

  [[nodiscard]] uint64_t bytes() const;  ///< device memory of all images
  [[nodiscard]] const MemorySharing& sharing() const { return sharing_; }

 private:
  struct Entry {
    std::vector<gpu::Image> images;
    uint32_t layers = 1;
    bool taken_over = false;  ///< its memory is somebody else's at other times
  };
  void bind(const gpu::Device& device);

  std::vector<gpu::Memory> heaps_;  ///< outlive the images
  MemorySharing sharing_;
  std::vector<Entry> entries_;
};

/// What the device says the values' images need, one entry a value. Binds no memory.
[[nodiscard]] std::vector<MemoryNeed> memory_needs(const gpu::Device& device, const Graph& graph);

/// share_memory, unless a heap would be more than the device gives in one allocation: then no value shares, and the
/// plan stays as it is.
MemorySharing share_on_device(const gpu::Device& device, Plan& plan, std::span<const MemoryNeed> needs);

/// Fills one layer (all layers: `layer` = VK_REMAINING_ARRAY_LAYERS) of an image in GENERAL with a colour; depth images
/// take its first component, unsigned formats its components cast to unsigned.
void record_clear(VkCommandBuffer commands, const gpu::Image& image, uint32_t layer, const ClearColor& color);

}  // namespace lightloom::run
