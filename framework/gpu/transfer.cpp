#include "framework/gpu/transfer.hpp"

#include <algorithm>
#include <cstring>

#include "framework/base/error.hpp"
#include "framework/gpu/format.hpp"

namespace lightloom::gpu {
namespace {

/// Staging is done in pieces, so that a large scene does not need its size twice.
constexpr VkDeviceSize kStagingBytes = 64ull << 20;

VkDeviceSize region_bytes(const Image& image, const Extent3& extent) {
  return VkDeviceSize{extent.width} * extent.height * extent.depth * texel_bytes(image.spec().format);
}

VkBufferImageCopy copy_of(const Image& image, const ImageRegion& region, VkDeviceSize offset) {
  VkBufferImageCopy copy{};
  copy.bufferOffset = offset;
  copy.imageSubresource = {image.aspect(), region.mip_level, region.layer, 1};
  copy.imageOffset = region.offset;
  copy.imageExtent = {region.extent.width, region.extent.height, region.extent.depth};
  return copy;
}

void memory_barrier(VkCommandBuffer commands, const VkMemoryBarrier2& barrier) {
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

void host_read_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  memory_barrier(commands, barrier);
}

VkDeviceSize round_up(VkDeviceSize value, VkDeviceSize step) {
  return (value + step - 1) / step * step;
}

/// Buffer offsets of image copies must be multiples of the texel size; 16 is one of all ours.
constexpr VkDeviceSize kCopyAlignment = 16;

/// Copies a run of subimages through one staging buffer.
void upload_batch(Device& device, const Image& target, std::span<const SubimageData> batch, VkDeviceSize bytes) {
  const Buffer staging(device, bytes, 0, MemoryKind::upload, "staging of " + target.spec().name);
  std::vector<VkBufferImageCopy> copies;
  VkDeviceSize offset = 0;
  for (const SubimageData& data : batch) {
    std::memcpy(staging.mapped().data() + offset, data.texels.data(), data.texels.size());
    copies.push_back(copy_of(target, whole_level(target, data.layer, data.mip_level), offset));
    offset += round_up(data.texels.size(), kCopyAlignment);
  }
  device.run_commands([&](VkCommandBuffer commands) {
    record_full_barrier(commands);
    vkCmdCopyBufferToImage(commands, staging.get(), target.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           static_cast<uint32_t>(copies.size()), copies.data());
  });
}

void require_fit(const Image& target, const SubimageData& data) {
  const ImageSpec& spec = target.spec();
  const bool exists = data.layer < spec.layers && data.mip_level < spec.mip_levels;
  const VkDeviceSize expected = exists ? region_bytes(target, mip_extent(spec.extent, data.mip_level)) : 0;
  if (exists && data.texels.size() == expected) return;
  throw Error(ExitCode::run_failed, "upload to image '" + spec.name + "', layer " + std::to_string(data.layer) +
                                        ", mip level " + std::to_string(data.mip_level) + " has " +
                                        std::to_string(data.texels.size()) + " bytes instead of " +
                                        std::to_string(expected));
}

}  // namespace

Extent3 mip_extent(const Extent3& extent, uint32_t level) {
  const auto shrink = [&](uint32_t size) { return std::max(size >> level, 1u); };
  return {shrink(extent.width), shrink(extent.height), shrink(extent.depth)};
}

ImageRegion whole_level(const Image& image, uint32_t layer, uint32_t mip_level) {
  return {.layer = layer, .mip_level = mip_level, .offset = {}, .extent = mip_extent(image.spec().extent, mip_level)};
}

void record_full_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  memory_barrier(commands, barrier);
}

void record_layout_change(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.get();
  barrier.subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

void record_image_to_buffer(VkCommandBuffer commands, const Image& source, const ImageRegion& region,
                            VkImageLayout layout, VkBuffer target, VkDeviceSize offset) {
  const VkBufferImageCopy copy = copy_of(source, region, offset);
  vkCmdCopyImageToBuffer(commands, source.get(), layout, target, 1, &copy);
}

void record_buffer_to_image(VkCommandBuffer commands, VkBuffer source, VkDeviceSize offset, const Image& target,
                            const ImageRegion& region, VkImageLayout layout) {
  const VkBufferImageCopy copy = copy_of(target, region, offset);
  vkCmdCopyBufferToImage(commands, source, target.get(), layout, 1, &copy);
}

void upload_buffer(Device& device, const Buffer& target, std::span<const std::byte> data, VkDeviceSize offset) {
  if (offset > target.size() || data.size() > target.size() - offset) {
    throw Error(ExitCode::run_failed, "upload of " + std::to_string(data.size()) + " bytes at " +
                                          std::to_string(offset) + " does not fit into buffer '" + target.name() +
                                          "' of " + std::to_string(target.size()) + " bytes");
  }
  if (data.empty()) return;
  if (!target.mapped().empty()) {
    std::memcpy(target.mapped().data() + offset, data.data(), data.size());
    return;
  }
  const Buffer staging(device, std::min<VkDeviceSize>(data.size(), kStagingBytes), 0, MemoryKind::upload,
                       "staging of " + target.name());
  for (VkDeviceSize done = 0; done < data.size(); done += staging.size()) {
    const VkDeviceSize piece = std::min<VkDeviceSize>(staging.size(), data.size() - done);
    std::memcpy(staging.mapped().data(), data.data() + done, piece);
    device.run_commands([&](VkCommandBuffer commands) {
      record_full_barrier(commands);
      const VkBufferCopy copy{0, offset + done, piece};
      vkCmdCopyBuffer(commands, staging.get(), target.get(), 1, &copy);
      record_full_barrier(commands);
    });
  }
}

std::vector<std::byte> read_buffer(Device& device, const Buffer& source) {
  std::vector<std::byte> bytes(source.size());
  const Buffer readback(device, std::min(source.size(), kStagingBytes), 0, MemoryKind::readback,
                        "read-back of " + source.name());
  for (VkDeviceSize done = 0; done < source.size(); done += readback.size()) {
    const VkDeviceSize piece = std::min(readback.size(), source.size() - done);
    device.run_commands([&](VkCommandBuffer commands) {
      record_full_barrier(commands);
      const VkBufferCopy copy{done, 0, piece};
      vkCmdCopyBuffer(commands, source.get(), readback.get(), 1, &copy);
      host_read_barrier(commands);
    });
    std::memcpy(bytes.data() + done, readback.mapped().data(), piece);
  }
  return bytes;
}

void upload_image(Device& device, const Image& target, std::span<const SubimageData> subimages,
                  VkImageLayout final_layout) {
  for (const SubimageData& data : subimages) require_fit(target, data);
  device.run_commands([&](VkCommandBuffer commands) {
    record_layout_change(commands, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  });
  for (size_t first = 0; first < subimages.size();) {
    VkDeviceSize bytes = 0;
    size_t end = first;
    while (end < subimages.size() && (end == first || bytes + subimages[end].texels.size() <= kStagingBytes)) {
      bytes += round_up(subimages[end].texels.size(), kCopyAlignment);
      ++end;
    }
    upload_batch(device, target, subimages.subspan(first, end - first), bytes);
    first = end;
  }
  device.run_commands([&](VkCommandBuffer commands) {
    record_layout_change(commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, final_layout);
  });
}

std::vector<std::byte> read_image(Device& device, const Image& source, const ImageRegion& region,
                                  VkImageLayout layout) {
  const Buffer readback(device, region_bytes(source, region.extent), 0, MemoryKind::readback,
                        "read-back of " + source.spec().name);
  device.run_commands([&](VkCommandBuffer commands) {
    record_full_barrier(commands);
    record_image_to_buffer(commands, source, region, layout, readback.get(), 0);
    host_read_barrier(commands);
  });
  return {readback.mapped().begin(), readback.mapped().end()};
}

}  // namespace lightloom::gpu
