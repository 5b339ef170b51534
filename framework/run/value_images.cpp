#include "framework/run/value_images.hpp"

#include "framework/gpu/format.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/device_room.hpp"

namespace lightloom::run {
namespace {

VkImageUsageFlags usage_of(Access access) {
  switch (access) {
    case Access::compute_storage_read:
    case Access::compute_storage_write:
    case Access::compute_storage_read_write:
    case Access::fragment_storage_read_write:
      return VK_IMAGE_USAGE_STORAGE_BIT;
    case Access::color_attachment_write:
      return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    case Access::depth_attachment_write:
      return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    case Access::none:
    case Access::compute_sampled_read:
    case Access::fragment_sampled_read:
    case Access::transfer_read:
    case Access::transfer_write:
    case Access::host_read:
    case Access::frame_input_read:
      return 0;
  }
  return 0;
}

std::vector<VkImageUsageFlags> usages(const Graph& graph) {
  // A storage scratch may be read as a texture by a later command of its pass, and a constant needs a usage that allows
  // a view; so everything may be sampled.
  constexpr VkImageUsageFlags kAlways =
      VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  std::vector<VkImageUsageFlags> result(graph.values.size(), kAlways);
  const auto add = [&](const std::vector<Use>& uses) {
    for (const Use& use : uses) result[use.value] |= usage_of(use.access);
  };
  for (const GraphPass& pass : graph.passes) {
    add(pass.inputs);
    add(pass.outputs);
    add(pass.scratch);
  }
  return result;
}

}  // namespace

ValueImages::ValueImages(const gpu::Device& device, const Plan& plan) {
  const Graph& graph = plan.graph;
  require_room(graph, room_of(device));
  const std::vector<VkImageUsageFlags> usage = usages(graph);
  for (size_t id = 0; id < graph.values.size(); ++id) {
    const Value& value = graph.values[id];
    Entry entry;
    entry.layers = ring_layers(value);
    const bool volume = value.desc.dimension == Dimension::d3;
    const gpu::ImageSpec spec{.format = gpu::vulkan_format(value.desc.format),
                              .dimension = value.desc.dimension,
                              .extent = value.desc.extent,
                              .layers = volume ? 1 : entry.layers,
                              .mip_levels = 1,
                              .usage = usage[id],
                              .name = value_name(value)};
    for (uint32_t i = 0; i < (volume ? entry.layers : 1); ++i) entry.images.emplace_back(device, spec);
    entries_.push_back(std::move(entry));
  }
}

uint32_t ValueImages::ring(ValueId value) const {
  return entries_.at(value).layers;
}

uint32_t ValueImages::newest(ValueId value, uint64_t count) const {
  return static_cast<uint32_t>(count % entries_.at(value).layers);
}

ValueLayer ValueImages::layer(ValueId value, uint32_t age, uint64_t count) const {
  const Entry& entry = entries_.at(value);
  const uint32_t index = (newest(value, count) + entry.layers - age) % entry.layers;
  if (entry.images.size() > 1) return {&entry.images[index], 0};
  return {&entry.images.front(), index};
}

gpu::ImageView ValueImages::view(ValueId value, uint32_t age, uint64_t count) const {
  const ValueLayer found = layer(value, age, count);
  if (found.image->spec().dimension == Dimension::d3) return found.image->view();
  return found.image->layer_view(found.layer);
}

gpu::ImageView ValueImages::array_view(ValueId value) const {
  return entries_.at(value).images.front().array_view();
}

void ValueImages::record_initialisation(VkCommandBuffer commands) const {
  for (const Entry& entry : entries_) {
    for (const gpu::Image& image : entry.images) {
      gpu::record_layout_change(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
      run::record_clear(commands, image, VK_REMAINING_ARRAY_LAYERS, {});
    }
  }
}

void ValueImages::record_clear(VkCommandBuffer commands, const Clear& clear) const {
  for (const gpu::Image& image : entries_.at(clear.value).images)
    run::record_clear(commands, image, VK_REMAINING_ARRAY_LAYERS, clear.color);
}

uint64_t ValueImages::bytes() const {
  uint64_t total = 0;
  for (const Entry& entry : entries_)
    for (const gpu::Image& image : entry.images) total += image.memory_bytes();
  return total;
}

void record_clear(VkCommandBuffer commands, const gpu::Image& image, uint32_t layer, const ClearColor& color) {
  const bool all = layer == VK_REMAINING_ARRAY_LAYERS;
  const VkImageSubresourceRange range{image.aspect(), 0, VK_REMAINING_MIP_LEVELS, all ? 0 : layer,
                                      all ? VK_REMAINING_ARRAY_LAYERS : 1};
  if (image.aspect() == VK_IMAGE_ASPECT_DEPTH_BIT) {
    const VkClearDepthStencilValue depth{color[0], 0};
    vkCmdClearDepthStencilImage(commands, image.get(), VK_IMAGE_LAYOUT_GENERAL, &depth, 1, &range);
    return;
  }
  VkClearColorValue value{};
  const bool is_unsigned = gpu::numeric_class(image.spec().format) == NumericClass::unsigned_integer;
  for (size_t channel = 0; channel < color.size(); ++channel) {
    if (is_unsigned)
      value.uint32[channel] = static_cast<uint32_t>(color[channel]);
    else
      value.float32[channel] = color[channel];
  }
  vkCmdClearColorImage(commands, image.get(), VK_IMAGE_LAYOUT_GENERAL, &value, 1, &range);
}

}  // namespace lightloom::run
