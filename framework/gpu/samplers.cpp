#include "framework/gpu/samplers.hpp"

#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

SamplerHandle make_sampler(const Device& device, VkSamplerAddressMode u, VkSamplerAddressMode v, bool mipmaps) {
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = mipmaps ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = u;
  info.addressModeV = v;
  info.addressModeW = v;
  info.maxLod = mipmaps ? VK_LOD_CLAMP_NONE : 0.0f;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device.get(), &info, nullptr, &sampler), "vkCreateSampler");
  return SamplerHandle(device.ref(), sampler);
}

}  // namespace

Samplers::Samplers(const Device& device)
    : repeat_trilinear_(make_sampler(device, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT, true)),
      clamp_linear_(
          make_sampler(device, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false)),
      equirectangular_(
          make_sampler(device, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false)) {}

}  // namespace lightloom::gpu
