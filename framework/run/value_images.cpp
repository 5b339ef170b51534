#include "framework/run/value_images.hpp"

#include <algorithm>
#include <map>
#include <optional>

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
    case Access::anything:
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

/// One image a value, or one a layer for the ring of a volume.
std::vector<gpu::Image> unbound_images(const gpu::Device& device, const Value& value, VkImageUsageFlags usage) {
  const bool volume = value.desc.dimension == Dimension::d3;
  const gpu::ImageSpec spec{.format = gpu::vulkan_format(value.desc.format),
                            .dimension = value.desc.dimension,
                            .extent = value.desc.extent,
                            .layers = volume ? 1 : ring_layers(value),
                            .mip_levels = 1,
                            .usage = usage,
                            .name = value_name(value)};
  std::vector<gpu::Image> images;
  for (uint32_t i = 0; i < (volume ? ring_layers(value) : 1); ++i) images.push_back(gpu::Image::unbound(device, spec));
  return images;
}

MemoryNeed need_of(const gpu::Image& image) {
  const VkMemoryRequirements& requirements = image.requirements();
  return {requirements.size, requirements.alignment, requirements.memoryTypeBits};
}

}  // namespace

std::vector<MemoryNeed> memory_needs(const gpu::Device& device, const Graph& graph) {
  const std::vector<VkImageUsageFlags> usage = usages(graph);
  std::vector<MemoryNeed> needs;
  for (size_t id = 0; id < graph.values.size(); ++id)
    needs.push_back(need_of(unbound_images(device, graph.values[id], usage[id]).front()));
  return needs;
}

MemorySharing share_on_device(const gpu::Device& device, Plan& plan, std::span<const MemoryNeed> needs) {
  Plan shared = plan;
  MemorySharing sharing = share_memory(shared, needs);
  const uint64_t limit = device.info().max_allocation_bytes;
  const bool fits = std::all_of(sharing.heaps.begin(), sharing.heaps.end(),
                                [&](const SharedHeap& heap) { return limit == 0 || heap.bytes <= limit; });
  // One allocation cannot hold them all: apart, each may still find its place.
  if (!fits) return {{}, std::vector<std::optional<SharedPlace>>(needs.size())};
  plan = std::move(shared);
  return sharing;
}

ValueImages::ValueImages(const gpu::Device& device, Plan& plan, bool share) {
  require_room(plan.graph, room_of(device));
  const std::vector<VkImageUsageFlags> usage = usages(plan.graph);
  for (size_t id = 0; id < plan.graph.values.size(); ++id) {
    const Value& value = plan.graph.values[id];
    Entry entry;
    entry.images = unbound_images(device, value, usage[id]);
    entry.layers = ring_layers(value);
    entries_.push_back(std::move(entry));
  }
  sharing_.places.resize(entries_.size());
  if (share) {
    std::vector<MemoryNeed> needs;
    for (const Entry& entry : entries_) needs.push_back(need_of(entry.images.front()));
    sharing_ = share_on_device(device, plan, needs);
  }
  bind(device);
  for (const PlanStep& step : plan.steps)
    for (const Barrier& barrier : step.barriers)
      if (barrier.takes_over) entries_[barrier.value].taken_over = true;
}

void ValueImages::bind(const gpu::Device& device) {
  std::vector<VkMemoryRequirements> needs(sharing_.heaps.size());
  for (size_t id = 0; id < entries_.size(); ++id) {
    if (!sharing_.places[id]) continue;
    VkMemoryRequirements& need = needs[sharing_.places[id]->heap];
    const VkMemoryRequirements& own = entries_[id].images.front().requirements();
    need = {sharing_.heaps[sharing_.places[id]->heap].bytes, std::max(need.alignment, own.alignment),
            own.memoryTypeBits};
  }
  for (const VkMemoryRequirements& need : needs)
    heaps_.push_back(gpu::allocate_memory(device, need, gpu::MemoryKind::device, "memory that values share"));
  for (size_t id = 0; id < entries_.size(); ++id) {
    const std::optional<SharedPlace>& place = sharing_.places[id];
    for (gpu::Image& image : entries_[id].images) {
      if (place)
        image.bind(device, heaps_[place->heap].get(), place->offset);
      else
        image.bind_own(device);
    }
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
    if (entry.taken_over) continue;
    for (const gpu::Image& image : entry.images) {
      gpu::record_layout_change(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
      run::record_clear(commands, image, VK_REMAINING_ARRAY_LAYERS, {});
    }
  }
}

std::vector<VkImageMemoryBarrier2> ValueImages::takeovers(std::span<const Barrier> barriers) const {
  std::map<ValueId, VkImageMemoryBarrier2> images;
  for (const Barrier& barrier : barriers) {
    if (!barrier.takes_over) continue;
    const gpu::Image& image = entries_.at(barrier.value).images.front();
    VkImageMemoryBarrier2& merged = images[barrier.value];
    merged.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    merged.srcStageMask |= access_info(barrier.from).stages;
    merged.srcAccessMask |= access_info(barrier.from).access;
    merged.dstStageMask |= access_info(barrier.to).stages;
    merged.dstAccessMask |= access_info(barrier.to).access;
    merged.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    merged.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    merged.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    merged.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    merged.image = image.get();
    merged.subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  }
  std::vector<VkImageMemoryBarrier2> list;
  for (const auto& [value, barrier] : images) list.push_back(barrier);
  return list;
}

void ValueImages::record_clear(VkCommandBuffer commands, const Clear& clear) const {
  for (const gpu::Image& image : entries_.at(clear.value).images)
    run::record_clear(commands, image, VK_REMAINING_ARRAY_LAYERS, clear.color);
}

uint64_t ValueImages::bytes() const {
  uint64_t total = 0;
  for (const SharedHeap& heap : sharing_.heaps) total += heap.bytes;
  for (size_t id = 0; id < entries_.size(); ++id) {
    if (sharing_.places[id]) continue;
    for (const gpu::Image& image : entries_[id].images) total += image.memory_bytes();
  }
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
