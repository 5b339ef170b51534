#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/image.hpp"

namespace lightloom::gpu {

/// Texels of one mip level of one layer (all slices of a 3D image), tightly packed, x fastest, then y, then z.
struct SubimageData {
  uint32_t layer = 0;
  uint32_t mip_level = 0;
  std::span<const std::byte> texels;
};

/// A box of one mip level of one layer.
struct ImageRegion {
  uint32_t layer = 0;
  uint32_t mip_level = 0;
  VkOffset3D offset{0, 0, 0};
  Extent3 extent;
};

[[nodiscard]] Extent3 mip_extent(const Extent3& extent, uint32_t level);
[[nodiscard]] ImageRegion whole_level(const Image& image, uint32_t layer = 0, uint32_t mip_level = 0);

/// Copies into a buffer of any kind, staged where needed, and waits.
void upload_buffer(Device& device, const Buffer& target, std::span<const std::byte> data, VkDeviceSize offset = 0);
[[nodiscard]] std::vector<std::byte> read_buffer(Device& device, const Buffer& source);

/// Fills the given subimages and waits. The whole image ends in `final_layout`; what is not given is undefined after
/// it.
void upload_image(Device& device, const Image& target, std::span<const SubimageData> subimages,
                  VkImageLayout final_layout = VK_IMAGE_LAYOUT_GENERAL);

/// Reads a region back, tightly packed; the image is and stays in `layout` (GENERAL or TRANSFER_SRC_OPTIMAL).
[[nodiscard]] std::vector<std::byte> read_image(Device& device, const Image& source, const ImageRegion& region,
                                                VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL);

/// Records the copy of a region to a buffer, tightly packed from `offset`; barriers are the caller's.
void record_image_to_buffer(VkCommandBuffer commands, const Image& source, const ImageRegion& region,
                            VkImageLayout layout, VkBuffer target, VkDeviceSize offset);

/// Records the copy of a tightly packed region from `offset` of a buffer; barriers are the caller's.
void record_buffer_to_image(VkCommandBuffer commands, VkBuffer source, VkDeviceSize offset, const Image& target,
                            const ImageRegion& region, VkImageLayout layout);

/// Records a transition of all mip levels and layers that waits for all earlier commands.
void record_layout_change(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to);

/// Records a barrier that orders every earlier command before every later one and makes all writes visible.
void record_full_barrier(VkCommandBuffer commands);

}  // namespace lightloom::gpu
