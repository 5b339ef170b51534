#include "framework/run/readback.hpp"

#include <array>

#include "framework/gpu/transfer.hpp"
#include "framework/run/barriers.hpp"

namespace lightloom::run {

Readback::Readback(const gpu::Device& device, const Plan& plan, bool single_texels) : single_texels_(single_texels) {
  if (single_texels) texels_.resize(plan.graph.values.size());
  for (const Observation& observation : plan.opening_observations) add(device, plan.graph, observation);
  for (const PlanStep& step : plan.steps)
    for (const Observation& observation : step.observations) add(device, plan.graph, observation);
}

void Readback::add(const gpu::Device& device, const Graph& graph, const Observation& observation) {
  const Value& value = graph.values.at(observation.value);
  const Key key{observation.value, observation.age};
  ImageDesc desc = value.desc;
  if (single_texels_) desc.extent = {1, 1, 1};
  buffers_.try_emplace(key, device, byte_size(desc), 0, gpu::MemoryKind::readback, value_name(value));
  descs_.try_emplace(key, desc);
}

gpu::ImageRegion Readback::region(ValueId value, const ValueLayer& layer) const {
  if (!single_texels_) return gpu::whole_level(*layer.image, layer.layer);
  return {.layer = layer.layer, .mip_level = 0, .offset = texels_.at(value), .extent = {1, 1, 1}};
}

void Readback::record(VkCommandBuffer commands, const Observation& observation, const ValueImages& images,
                      uint64_t frame_count) const {
  const ValueLayer layer = images.layer(observation.value, observation.age, frame_count);
  gpu::record_image_to_buffer(commands, *layer.image, region(observation.value, layer), VK_IMAGE_LAYOUT_GENERAL,
                              buffers_.at({observation.value, observation.age}).get(), 0);
}

void Readback::record_end(VkCommandBuffer commands) {
  const std::array barrier{Barrier{.value = kFrameInputs,
                                   .from = Access::transfer_write,
                                   .to = Access::host_read,
                                   .hazard = Hazard::read_after_write,
                                   .previous_frame = false,
                                   .reason = "the host reads the copies"}};
  record_barriers(commands, barrier);
}

image::HostImage Readback::fetch(ValueId value, uint32_t age) const {
  const gpu::Buffer& buffer = buffers_.at({value, age});
  const std::span<std::byte> mapped = buffer.mapped();
  return {.desc = descs_.at({value, age}), .texels = std::vector<std::byte>(mapped.begin(), mapped.end())};
}

}  // namespace lightloom::run
