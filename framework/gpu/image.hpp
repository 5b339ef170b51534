#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/gpu/memory.hpp"
#include "framework/graph/desc.hpp"

namespace lightloom::gpu {

struct ImageSpec {
  VkFormat format = VK_FORMAT_UNDEFINED;
  Dimension dimension = Dimension::d2;
  Extent3 extent;       ///< of mip level 0 [texels]
  uint32_t layers = 1;  ///< 2D only: of a history ring or a texture page
  uint32_t mip_levels = 1;
  VkImageUsageFlags usage = 0;
  std::string name{};  ///< for messages
};

/// A view with what is needed to check it against a shader.
struct ImageView {
  VkImageView view = VK_NULL_HANDLE;
  VkImageViewType type = VK_IMAGE_VIEW_TYPE_2D;
  VkFormat format = VK_FORMAT_UNDEFINED;
};

/// An image in layout UNDEFINED after construction.
class Image {
 public:
  /// An image with its own memory. Throws Error(run_failed) for a shape or format that the device cannot do and when
  /// memory runs out; it names the image, the limit and the bytes asked.
  Image(const Device& device, const ImageSpec& spec);

  /// An image without memory: `bind_own` or `bind` must follow before anything else but `requirements`.
  [[nodiscard]] static Image unbound(const Device& device, const ImageSpec& spec);
  [[nodiscard]] const VkMemoryRequirements& requirements() const { return requirements_; }
  void bind_own(const Device& device);
  /// Binds to a part of `memory`, which must outlive the image.
  void bind(const Device& device, VkDeviceMemory memory, VkDeviceSize offset);

  [[nodiscard]] VkImage get() const { return image_.get(); }
  [[nodiscard]] const ImageSpec& spec() const { return spec_; }
  [[nodiscard]] VkImageAspectFlags aspect() const;
  /// All mip levels; 3D, or 2D (one layer), or a 2D array (more layers).
  [[nodiscard]] ImageView view() const { return full_; }
  /// All layers and mip levels of a 2D image as a 2D array, even if it has one layer.
  [[nodiscard]] ImageView array_view() const;
  /// One layer of a 2D image as a 2D view of mip level 0: for attachments, storage, and reading one age of a ring.
  [[nodiscard]] ImageView layer_view(uint32_t layer) const;
  [[nodiscard]] VkDeviceSize memory_bytes() const { return requirements_.size; }

 private:
  explicit Image(const ImageSpec& spec) : spec_(spec) {}
  void create(const Device& device);
  void make_views(const Device& device);
  [[nodiscard]] ImageViewHandle make_view(const Device& device, VkImageViewType type, uint32_t layer, uint32_t layers,
                                          uint32_t mips) const;

  ImageSpec spec_;
  VkMemoryRequirements requirements_{};
  Memory memory_;
  ImageHandle image_;
  ImageViewHandle full_handle_;
  ImageViewHandle array_handle_;
  std::vector<ImageViewHandle> layer_handles_;
  ImageView full_;
};

}  // namespace lightloom::gpu
