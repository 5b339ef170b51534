#include "framework/gpu/format.hpp"

#include <array>
#include <string>

#include "framework/base/error.hpp"

namespace lightloom::gpu {

VkFormat vulkan_format(Format format) {
  switch (format) {
    case Format::r8_unorm:
      return VK_FORMAT_R8_UNORM;
    case Format::rgba8_unorm:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::rgba16_unorm:
      return VK_FORMAT_R16G16B16A16_UNORM;
    case Format::r16_sfloat:
      return VK_FORMAT_R16_SFLOAT;
    case Format::rg16_sfloat:
      return VK_FORMAT_R16G16_SFLOAT;
    case Format::rgba16_sfloat:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::r32_sfloat:
      return VK_FORMAT_R32_SFLOAT;
    case Format::rg32_sfloat:
      return VK_FORMAT_R32G32_SFLOAT;
    case Format::rgba32_sfloat:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::r32_uint:
      return VK_FORMAT_R32_UINT;
    case Format::rg32_uint:
      return VK_FORMAT_R32G32_UINT;
    case Format::rgba32_uint:
      return VK_FORMAT_R32G32B32A32_UINT;
    case Format::d32_sfloat:
      return VK_FORMAT_D32_SFLOAT;
  }
  throw Error(ExitCode::run_failed,
              "format number " + std::to_string(static_cast<int>(format)) + " has no Vulkan format");
}

uint32_t texel_bytes(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8_UNORM:
      return 1;
    case VK_FORMAT_R16_SFLOAT:
      return 2;
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_D32_SFLOAT:
      return 4;
    case VK_FORMAT_R16G16B16A16_UNORM:
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
      return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
      return 16;
    default:
      throw Error(ExitCode::run_failed,
                  "the texel size of VkFormat " + std::to_string(static_cast<int>(format)) + " is not known");
  }
}

VkImageAspectFlags aspect_of(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

NumericClass numeric_class(VkFormat format) {
  const bool is_unsigned =
      format == VK_FORMAT_R32_UINT || format == VK_FORMAT_R32G32_UINT || format == VK_FORMAT_R32G32B32A32_UINT;
  return is_unsigned ? NumericClass::unsigned_integer : NumericClass::floating;
}

}  // namespace lightloom::gpu
