#include "framework/graph/access.hpp"

#include <array>
#include <cstddef>

namespace lightloom {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kColor = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags2 kDepth =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags2 kAnyShader = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | kFragment | kCompute;
// Copies and clears are named one by one, as the validation layer then tells them apart.
constexpr VkPipelineStageFlags2 kCopy = VK_PIPELINE_STAGE_2_COPY_BIT;
constexpr VkPipelineStageFlags2 kCopyOrClear = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
constexpr VkImageLayout kGeneral = VK_IMAGE_LAYOUT_GENERAL;

constexpr std::array<AccessInfo, 14> kAccesses{{
    {"none", VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED, false, false},
    {"compute_sampled_read", kCompute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, kGeneral, true, false},
    {"compute_storage_read", kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, kGeneral, true, false},
    {"compute_storage_write", kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kGeneral, false, true},
    {"compute_storage_read_write", kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
     kGeneral, true, true},
    {"fragment_sampled_read", kFragment, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, kGeneral, true, false},
    {"fragment_storage_read_write", kFragment,
     VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kGeneral, true, true},
    // Loading, blending and logic operations read the attachment; load operations count as writes or reads by their
    // kind.
    {"color_attachment_write", kColor, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
     kGeneral, true, true},
    {"depth_attachment_write", kDepth,
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, kGeneral, true,
     true},
    {"transfer_read", kCopy, VK_ACCESS_2_TRANSFER_READ_BIT, kGeneral, true, false},
    {"transfer_write", kCopyOrClear, VK_ACCESS_2_TRANSFER_WRITE_BIT, kGeneral, false, true},
    {"host_read", VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, kGeneral, true, false},
    {"frame_input_read", kAnyShader,
     VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, kGeneral,
     true, false},
    {"anything", VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
     kGeneral, true, true},
}};
static_assert(kAccesses.size() == static_cast<std::size_t>(Access::anything) + 1);

}  // namespace

const AccessInfo& access_info(Access access) {
  return kAccesses.at(static_cast<std::size_t>(access));
}

}  // namespace lightloom
