#include "framework/gpu/rendering.hpp"

#include <vector>

namespace lightloom::gpu {
namespace {

VkRenderingAttachmentInfo attachment(VkImageView view, bool clear, const VkClearValue& value) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = view;
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  info.clearValue = value;
  return info;
}

}  // namespace

void begin_rendering(VkCommandBuffer commands, VkExtent2D extent, std::span<const ColorTarget> colors,
                     const std::optional<DepthTarget>& depth) {
  std::vector<VkRenderingAttachmentInfo> color_infos;
  for (const ColorTarget& color : colors) {
    VkClearValue value{};
    value.color = color.clear.value_or(VkClearColorValue{});
    color_infos.push_back(attachment(color.view.view, color.clear.has_value(), value));
  }
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea = {{0, 0}, extent};
  info.layerCount = 1;
  info.colorAttachmentCount = static_cast<uint32_t>(color_infos.size());
  info.pColorAttachments = color_infos.data();
  VkRenderingAttachmentInfo depth_info{};
  if (depth) {
    VkClearValue value{};
    value.depthStencil.depth = depth->clear.value_or(1.0f);
    depth_info = attachment(depth->view.view, depth->clear.has_value(), value);
    info.pDepthAttachment = &depth_info;
  }
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  const VkRect2D scissor{{0, 0}, extent};
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

}  // namespace lightloom::gpu
