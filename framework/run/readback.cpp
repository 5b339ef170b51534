#include "framework/run/readback.hpp"

#include <array>

#include "framework/gpu/transfer.hpp"
#include "framework/run/barriers.hpp"

namespace lightloom::run {

image::HostImage FrameCopies::fetch(ValueId value, uint32_t age) const {
  const Copy& copy = copies_.at({value, age});
  const std::span<std::byte> mapped = copy.buffer.mapped();
  return {.desc = copy.desc, .texels = std::vector<std::byte>(mapped.begin(), mapped.end())};
}

Readback::Readback(const gpu::Device& device, const Plan& plan, bool single_texels)
    : device_(device), single_texels_(single_texels) {
  if (single_texels) texels_.resize(plan.graph.values.size());
  const auto add = [&](const std::vector<Observation>& observations) {
    for (const Observation& observation : observations)
      if (observation.observer == Observer::read_back)
        observed_.try_emplace({observation.value, observation.age}, plan.graph.values.at(observation.value));
  };
  add(plan.opening_observations);
  for (const PlanStep& step : plan.steps) add(step.observations);
  for (const GraphOutput& output : plan.graph.outputs) outputs_.emplace(output.value, output.age);
  for (const ValueId capture : plan.graph.captures) captures_.emplace(capture, 0);
}

gpu::ImageRegion Readback::region(ValueId value, const ValueLayer& layer) const {
  if (!single_texels_) return gpu::whole_level(*layer.image, layer.layer);
  return {.layer = layer.layer, .mip_level = 0, .offset = texels_.at(value), .extent = {1, 1, 1}};
}

FrameCopies::Copy Readback::make_copy(const Value& value) const {
  ImageDesc desc = value.desc;
  if (single_texels_) desc.extent = {1, 1, 1};
  return {{device_, byte_size(desc), 0, gpu::MemoryKind::readback, value_name(value)}, desc};
}

bool Readback::wants_copy(const Key& key, const FrameWants& wants) const {
  const bool output = outputs_.contains(key);
  const bool capture = captures_.contains(key);
  return (wants.outputs && output) || (wants.captures && capture) || (!output && !capture);
}

std::shared_ptr<const FrameCopies> Readback::acquire(const FrameWants& wants) {
  std::unique_ptr<FrameCopies> set;
  {
    const std::lock_guard lock(pool_->mutex);
    if (!pool_->free.empty()) {
      set = std::move(pool_->free.back());
      pool_->free.pop_back();
    }
  }
  if (!set) {
    set = std::make_unique<FrameCopies>();
    ++set_count_;
  }
  set->wanted_.clear();
  for (const auto& [key, value] : observed_) {
    if (!wants_copy(key, wants)) continue;
    set->wanted_.insert(key);
    if (!set->copies_.contains(key)) set->copies_.emplace(key, make_copy(value));
  }
  return {set.release(), [pool = pool_](FrameCopies* done) {
            std::unique_ptr<FrameCopies> owned(done);
            const std::lock_guard lock(pool->mutex);
            pool->free.push_back(std::move(owned));
          }};
}

void Readback::record(VkCommandBuffer commands, const Observation& observation, const ValueImages& images,
                      uint64_t frame_count, const FrameCopies& copies) const {
  const Key key{observation.value, observation.age};
  if (!copies.wanted_.contains(key)) return;
  const ValueLayer layer = images.layer(observation.value, observation.age, frame_count);
  gpu::record_image_to_buffer(commands, *layer.image, region(observation.value, layer), VK_IMAGE_LAYOUT_GENERAL,
                              copies.copies_.at(key).buffer.get(), 0);
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

}  // namespace lightloom::run
