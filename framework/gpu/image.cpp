#include "framework/gpu/image.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/gpu/format.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

std::string describe(const ImageSpec& spec) {
  std::string shape = std::to_string(spec.extent.width) + "x" + std::to_string(spec.extent.height);
  if (spec.dimension == Dimension::d3) shape += "x" + std::to_string(spec.extent.depth);
  if (spec.layers > 1) shape += ", " + std::to_string(spec.layers) + " layers";
  return "image '" + spec.name + "' (" + shape + ")";
}

VkImageCreateInfo create_info(const ImageSpec& spec) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = spec.dimension == Dimension::d3 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = spec.format;
  info.extent = {spec.extent.width, spec.extent.height, spec.extent.depth};
  info.mipLevels = spec.mip_levels;
  info.arrayLayers = spec.layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = spec.usage;
  return info;
}

void check_limits(const Device& device, const ImageSpec& spec) {
  const std::string owner = describe(spec);
  const Extent3& extent = spec.extent;
  const bool volume = spec.dimension == Dimension::d3;
  if (std::min({extent.width, extent.height, extent.depth, spec.layers, spec.mip_levels}) == 0) {
    throw Error(ExitCode::run_failed, owner + " has an extent of 0");
  }
  if (volume ? spec.layers != 1 : extent.depth != 1) {
    throw Error(ExitCode::run_failed, owner + (volume ? " is 3D and has layers" : " is 2D and has a depth"));
  }
  VkImageFormatProperties limits{};
  const VkImageCreateInfo info = create_info(spec);
  const VkResult result = vkGetPhysicalDeviceImageFormatProperties(device.physical(), info.format, info.imageType,
                                                                   info.tiling, info.usage, info.flags, &limits);
  const std::string on_device = " on device '" + device.info().name + "'";
  if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) {
    throw Error(ExitCode::run_failed, owner + " has a format (VkFormat " + std::to_string(spec.format) +
                                          ") that cannot be used this way" + on_device);
  }
  check(result, "vkGetPhysicalDeviceImageFormatProperties for " + owner);
  const auto require = [&](uint32_t value, uint32_t limit, const char* what) {
    if (value <= limit) return;
    throw Error(ExitCode::run_failed, owner + " exceeds the limit of " + std::to_string(limit) + " " + what + on_device,
                "choose a smaller size or resolution");
  };
  require(extent.width, limits.maxExtent.width, "texels of width");
  require(extent.height, limits.maxExtent.height, "texels of height");
  require(extent.depth, limits.maxExtent.depth, "texels of depth");
  require(spec.layers, limits.maxArrayLayers, "layers");
  require(spec.mip_levels, limits.maxMipLevels, "mip levels");
  // Mip levels below the first add at most as much again.
  const uint64_t bytes = uint64_t{extent.width} * extent.height * extent.depth * spec.layers * texel_bytes(spec.format);
  if (bytes > limits.maxResourceSize) {
    throw Error(ExitCode::run_failed,
                owner + " needs " + bytes_text(bytes) + ", more than the " + bytes_text(limits.maxResourceSize) +
                    " that one image may have" + on_device,
                "choose a smaller size or resolution");
  }
}

}  // namespace

Image::Image(const Device& device, const ImageSpec& spec) : spec_(spec) {
  create(device);
  bind_own(device);
}

Image Image::unbound(const Device& device, const ImageSpec& spec) {
  Image image(spec);
  image.create(device);
  return image;
}

void Image::create(const Device& device) {
  check_limits(device, spec_);
  const VkImageCreateInfo info = create_info(spec_);
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device.get(), &info, nullptr, &image), "vkCreateImage for " + describe(spec_));
  image_ = ImageHandle(device.ref(), image);
  device.set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image), spec_.name);
  vkGetImageMemoryRequirements(device.get(), image, &requirements_);
}

void Image::bind_own(const Device& device) {
  VkMemoryDedicatedAllocateInfo dedicated{};
  dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  dedicated.image = image_.get();
  memory_ = allocate_memory(device, requirements_, MemoryKind::device, describe(spec_), dedicated);
  bind(device, memory_.get(), 0);
}

void Image::bind(const Device& device, VkDeviceMemory memory, VkDeviceSize offset) {
  check(vkBindImageMemory(device.get(), image_.get(), memory, offset), "vkBindImageMemory for " + describe(spec_));
  make_views(device);
}

void Image::make_views(const Device& device) {
  constexpr VkImageUsageFlags kViewed = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  if ((spec_.usage & kViewed) == 0) return;
  if (spec_.dimension == Dimension::d3) {
    full_handle_ = make_view(device, VK_IMAGE_VIEW_TYPE_3D, 0, 1, spec_.mip_levels);
    full_ = {full_handle_.get(), VK_IMAGE_VIEW_TYPE_3D, spec_.format};
    return;
  }
  array_handle_ = make_view(device, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, spec_.layers, spec_.mip_levels);
  for (uint32_t layer = 0; layer < spec_.layers; ++layer) {
    layer_handles_.push_back(make_view(device, VK_IMAGE_VIEW_TYPE_2D, layer, 1, 1));
  }
  full_ = array_view();
  if (spec_.layers > 1) return;
  full_handle_ = make_view(device, VK_IMAGE_VIEW_TYPE_2D, 0, 1, spec_.mip_levels);
  full_ = {full_handle_.get(), VK_IMAGE_VIEW_TYPE_2D, spec_.format};
}

ImageViewHandle Image::make_view(const Device& device, VkImageViewType type, uint32_t layer, uint32_t layers,
                                 uint32_t mips) const {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image_.get();
  info.viewType = type;
  info.format = spec_.format;
  info.subresourceRange = {aspect(), 0, mips, layer, layers};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.get(), &info, nullptr, &view), "vkCreateImageView for " + describe(spec_));
  device.set_name(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<uint64_t>(view), spec_.name);
  return ImageViewHandle(device.ref(), view);
}

VkImageAspectFlags Image::aspect() const {
  return aspect_of(spec_.format);
}

ImageView Image::array_view() const {
  if (array_handle_.get() == VK_NULL_HANDLE) throw Error(ExitCode::run_failed, describe(spec_) + " has no array view");
  return {array_handle_.get(), VK_IMAGE_VIEW_TYPE_2D_ARRAY, spec_.format};
}

ImageView Image::layer_view(uint32_t layer) const {
  if (layer >= layer_handles_.size()) {
    throw Error(ExitCode::run_failed, describe(spec_) + " has no view of layer " + std::to_string(layer));
  }
  return {layer_handles_[layer].get(), VK_IMAGE_VIEW_TYPE_2D, spec_.format};
}

}  // namespace lightloom::gpu
