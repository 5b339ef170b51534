#include "framework/run/poison.hpp"

#include <algorithm>

#include "framework/gpu/transfer.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/slabs.hpp"

namespace lightloom::run {
namespace {

constexpr uint64_t kPatternBytes = 1u << 20;

/// Of a buffer that is filled by words of 32 bits.
uint32_t repeated(uint32_t bits, Format format) {
  switch (image::channel_bytes(image::channel_type(format))) {
    case 1:
      return bits * 0x01010101u;
    case 2:
      return bits * 0x00010001u;
    default:
      return bits;
  }
}

uint64_t pattern_bytes(const Graph& graph) {
  uint64_t bytes = 4;
  for (const Value& value : graph.values) bytes = std::max(bytes, largest_slab_bytes(value.desc, kPatternBytes));
  return (bytes + 3) / 4 * 4;
}

std::vector<const Use*> written_uses(const GraphPass& pass) {
  std::vector<const Use*> uses;
  for (const auto* list : {&pass.outputs, &pass.scratch})
    for (const Use& use : *list) uses.push_back(&use);
  return uses;
}

}  // namespace

uint32_t poison_bits(Format format, PoisonTone tone, uint64_t frame_count) {
  const bool nan = tone == PoisonTone::nan;
  // Two numbers that no clamp makes alike: of either sign, or, where there is none, a small and a large one.
  const bool low = frame_count % 2 == 0;
  if (format_info(format).depth) return nan ? 0x3eaf1c3du : 0x3f35b60bu;  // 0.342, 0.710
  switch (image::channel_type(format)) {
    case image::ChannelType::unorm8:
      return nan ? 0xa5u : (low ? 0x01u : 0x3cu);
    case image::ChannelType::unorm16:
      return nan ? 0xa5c3u : (low ? 0x0101u : 0x3c3cu);
    case image::ChannelType::half:
      return nan ? 0x7ed5u : (low ? 0xef1au : 0x6f1au);  // 7272
    case image::ChannelType::float32:
      return nan ? 0x7fd5b0a1u : (low ? 0xcb5aa5f1u : 0x4b5aa5f1u);  // 14329329
    case image::ChannelType::uint32:
      return nan ? 0xa5c3u : (low ? 0x0001u : 0x0b17u);
  }
  return 0;
}

Poison::Poison(const gpu::Device& device, const Plan& plan, PoisonTone tone)
    : graph_(plan.graph),
      tone_(tone),
      cleared_(graph_.values.size()),
      shares_(graph_.values.size()),
      pattern_(device, pattern_bytes(graph_), 0, gpu::MemoryKind::device, "poison") {
  for (const Clear& clear : plan.prologue) cleared_[clear.value] = true;
  std::vector<bool> within_frame(graph_.values.size());
  std::map<ValueId, uint32_t> last_pass;
  for (const PlanStep& step : plan.steps) {
    for (const Barrier& barrier : step.barriers)
      if (barrier.takes_over) shares_[barrier.value] = true;
    const GraphPass& pass = graph_.passes[step.pass];
    for (const Use* use : written_uses(pass)) within_frame[use->value] = !cleared_[use->value];
    for (const auto* uses : {&pass.inputs, &pass.outputs, &pass.scratch})
      for (const Use& use : *uses) last_pass[use.value] = step.pass;
  }
  for (const auto& [value, pass] : last_pass)
    if (within_frame[value]) last_used_[pass].push_back(value);
}

void Poison::record_initialisation(VkCommandBuffer commands, const ValueImages& images) const {
  for (ValueId value = 0; value < graph_.values.size(); ++value) {
    if (cleared_[value] || shares_[value]) continue;
    for (uint32_t age = 0; age < images.ring(value); ++age)
      record_fill(commands, value, images.layer(value, age, 0), 0);
  }
}

void Poison::record_before(VkCommandBuffer commands, const GraphPass& pass, const ValueImages& images,
                           uint64_t frame_count) const {
  for (const Use* use : written_uses(pass)) {
    if (graph_.values[use->value].persistent && frame_count > 0) continue;
    record_fill(commands, use->value, images.layer(use->value, 0, frame_count), frame_count);
  }
}

void Poison::record_after(VkCommandBuffer commands, const GraphPass& pass, const ValueImages& images,
                          uint64_t frame_count) const {
  const auto found = last_used_.find(static_cast<uint32_t>(&pass - graph_.passes.data()));
  if (found == last_used_.end()) return;
  for (const ValueId value : found->second)
    record_fill(commands, value, images.layer(value, 0, frame_count), frame_count);
}

void Poison::record_fill(VkCommandBuffer commands, ValueId value, const ValueLayer& layer, uint64_t frame_count) const {
  const ImageDesc& desc = graph_.values[value].desc;
  // Nothing is to be learnt here from overlap, and whoever was here before or comes after may be anyone.
  gpu::record_full_barrier(commands);
  vkCmdFillBuffer(commands, pattern_.get(), 0, VK_WHOLE_SIZE,
                  repeated(poison_bits(desc.format, tone_, frame_count), desc.format));
  gpu::record_full_barrier(commands);
  for (const Slab& slab : slabs_of(desc, kPatternBytes))
    gpu::record_buffer_to_image(commands, pattern_.get(), 0, *layer.image, region_of(slab, layer.layer),
                                VK_IMAGE_LAYOUT_GENERAL);
  gpu::record_full_barrier(commands);
}

}  // namespace lightloom::run
