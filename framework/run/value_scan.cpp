#include "framework/run/value_scan.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "framework/image/host_image.hpp"
#include "framework/run/slabs.hpp"

namespace lightloom::run {
namespace {

constexpr uint64_t kPieceBytes = 4u << 20;
/// Enough to fill a device; each invocation looks at several texels.
constexpr uint32_t kMostGroups = 256;

/// shaders/value_scan.comp
struct Record {
  uint32_t scanned = 0;
  uint32_t nan_texels = 0;
  uint32_t infinite_texels = 0;
  uint32_t pattern_texels = 0;
  uint32_t bad_from_end = 0;
  uint32_t pattern_from_end = 0;
  std::array<uint32_t, 2> digest{};
  std::array<uint32_t, 4> texel{};
};
static_assert(sizeof(Record) == 48);

uint32_t channel_kind(Format format) {
  switch (image::channel_type(format)) {
    case image::ChannelType::float32:
      return 0;
    case image::ChannelType::half:
      return 1;
    case image::ChannelType::uint32:
      return 2;
    case image::ChannelType::unorm8:
      return 3;
    case image::ChannelType::unorm16:
      return 4;
  }
  return 2;
}

std::optional<uint32_t> texel_number(uint32_t from_end) {
  if (from_end == 0) return std::nullopt;
  return UINT32_MAX - from_end;
}

std::vector<ValueId> values_to_scan(const Plan& plan) {
  std::vector<bool> read(plan.graph.values.size());
  for (const GraphPass& pass : plan.graph.passes)
    for (const Use& use : pass.inputs) read[use.value] = true;
  for (const GraphOutput& output : plan.graph.outputs) read[output.value] = true;
  for (const ValueId capture : plan.graph.captures) read[capture] = true;
  std::vector<ValueId> values;
  for (const auto* steps : {&plan.once, &plan.steps})
    for (const PlanStep& step : *steps)
      for (const Observation& observation : step.observations)
        if (observation.observer == Observer::scan &&
            (read[observation.value] || plan.graph.values[observation.value].scratch))
          values.push_back(observation.value);
  return values;
}

uint64_t piece_bytes(const Graph& graph, const std::vector<ValueId>& values) {
  uint64_t bytes = 4;
  for (const ValueId value : values) bytes = std::max(bytes, largest_slab_bytes(graph.values[value].desc, kPieceBytes));
  return (bytes + 3) / 4 * 4;
}

/// The scan's own commands touch nothing but its own buffers one after another, besides the value that it only reads.
void separate(VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = barrier.srcStageMask;
  barrier.dstAccessMask = barrier.srcAccessMask | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

ValueScan::ValueScan(const gpu::Device& device, const Plan& plan, ShaderLibrary& shaders,
                     std::optional<PoisonTone> poison)
    : graph_(plan.graph),
      shaders_(shaders),
      poison_(poison),
      scanned_(values_to_scan(plan)),
      texels_(device, piece_bytes(plan.graph, scanned_), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device,
              "texels to scan"),
      records_(device, sizeof(Record) * std::max<size_t>(scanned_.size(), 1), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               gpu::MemoryKind::device, "records of scans"),
      host_records_(device, records_.size(), 0, gpu::MemoryKind::readback, "records of scans on the host"),
      descriptors_(device) {
  for (uint32_t i = 0; i < scanned_.size(); ++i) record_of_[scanned_[i]] = i;
}

void ValueScan::record_begin(VkCommandBuffer commands) const {
  separate(commands);
  vkCmdFillBuffer(commands, records_.get(), 0, VK_WHOLE_SIZE, 0);
}

const ValueScan::Kernel& ValueScan::kernel(Format format, Stage stage) {
  const uint32_t kind = channel_kind(format);
  Kernel& kernel = kernels_[{kind, stage}];
  if (kernel.pipeline != nullptr) return kernel;
  const gpu::ShaderProgram& program = shaders_.program({"value_scan.comp"});
  const std::array constants{ShaderValue{"channel_kind", kind}, ShaderValue{"poisoned", poison_.has_value()},
                             ShaderValue{"stage", static_cast<uint32_t>(stage)}};
  kernel.pipeline = &shaders_.pipelines().compute(program, constants);
  kernel.set = descriptors_.allocate(*kernel.pipeline,
                                     {{"Texels", gpu::resource(texels_)}, {"Records", gpu::resource(records_)}});
  return kernel;
}

void ValueScan::record_kernel(VkCommandBuffer commands, const Kernel& kernel, std::span<const ShaderValue> params,
                              uint32_t groups) const {
  separate(commands);
  kernel.pipeline->bind(commands, kernel.set, gpu::encode_push_constants(kernel.pipeline->reflection(), params));
  vkCmdDispatch(commands, groups, 1, 1);
}

void ValueScan::record(VkCommandBuffer commands, const Observation& observation, const ValueImages& images,
                       uint64_t frame_count) {
  const auto record = record_of_.find(observation.value);
  if (record == record_of_.end()) return;
  const ImageDesc& desc = graph_.values[observation.value].desc;
  const ValueLayer layer = images.layer(observation.value, observation.age, frame_count);
  const Kernel& search = kernel(desc.format, Stage::search);
  const Kernel& fetch = kernel(desc.format, Stage::fetch);
  const uint32_t local_size = search.pipeline->reflection().local_size[0];
  for (const Slab& slab : slabs_of(desc, kPieceBytes)) {
    separate(commands);
    gpu::record_image_to_buffer(commands, *layer.image, region_of(slab, layer.layer), VK_IMAGE_LAYOUT_GENERAL,
                                texels_.get(), 0);
    const std::array params{ShaderValue{"first_texel", slab.first_texel}, ShaderValue{"texel_count", slab.texels},
                            ShaderValue{"channels", format_info(desc.format).channels},
                            ShaderValue{"record_index", record->second},
                            ShaderValue{"pattern", poison_ ? poison_bits(desc.format, *poison_, frame_count) : 0u}};
    record_kernel(commands, search, params, std::min((slab.texels + local_size - 1) / local_size, kMostGroups));
    record_kernel(commands, fetch, params, 1);
  }
}

void ValueScan::record_end(VkCommandBuffer commands) const {
  separate(commands);
  const VkBufferCopy copy{0, 0, records_.size()};
  vkCmdCopyBuffer(commands, records_.get(), host_records_.get(), 1, &copy);
}

std::vector<ScannedValue> ValueScan::found() const {
  std::vector<ScannedValue> result;
  for (size_t i = 0; i < scanned_.size(); ++i) {
    Record record;
    std::memcpy(&record, host_records_.mapped().data() + i * sizeof(Record), sizeof(Record));
    if (record.scanned == 0) continue;
    result.push_back({.value = scanned_[i],
                      .nan_texels = record.nan_texels,
                      .infinite_texels = record.infinite_texels,
                      .first_bad = texel_number(record.bad_from_end),
                      .texel = record.texel,
                      .poison_texels = record.pattern_texels,
                      .first_poison = texel_number(record.pattern_from_end),
                      .digest = record.digest});
  }
  return result;
}

}  // namespace lightloom::run
