#pragma once

#include <vulkan/vulkan_core.h>

#include "framework/gpu/reflection.hpp"

namespace lightloom::gpu {

constexpr VkDescriptorType descriptor_type(BindingKind kind) {
  switch (kind) {
    case BindingKind::uniform_buffer:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::storage_buffer:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::sampled_image:
      return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    case BindingKind::combined_sampler:
      return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case BindingKind::storage_image:
      return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case BindingKind::acceleration_structure:
      return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    case BindingKind::sampler:
      break;
  }
  return VK_DESCRIPTOR_TYPE_SAMPLER;
}

constexpr VkShaderStageFlagBits stage_flag(Stage stage) {
  switch (stage) {
    case Stage::vertex:
      return VK_SHADER_STAGE_VERTEX_BIT;
    case Stage::fragment:
      return VK_SHADER_STAGE_FRAGMENT_BIT;
    case Stage::compute:
      break;
  }
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

}  // namespace lightloom::gpu
