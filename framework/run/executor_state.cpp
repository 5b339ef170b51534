#include "framework/run/executor_state.hpp"

#include <cstring>

#include "framework/base/error.hpp"
#include "framework/gpu/buffer.hpp"
#include "framework/gpu/transfer.hpp"

namespace lightloom::run {
namespace {

struct LayerKey {
  ValueId value = 0;
  uint32_t age = 0;
};

/// Hoisted values are not among them: they are made again.
std::vector<LayerKey> layers_to_keep(const Graph& graph) {
  std::vector<LayerKey> keys;
  for (ValueId id = 0; id < graph.values.size(); ++id) {
    const Value& value = graph.values[id];
    if (value.constant || (value.history == 0 && !value.persistent)) continue;
    for (uint32_t age = 0; age < ring_layers(value); ++age) keys.push_back({id, age});
  }
  return keys;
}

void upload_layer(gpu::Device& device, const ValueLayer& layer, const SavedLayer& saved) {
  const gpu::Buffer staging(device, saved.texels.size(), 0, gpu::MemoryKind::upload, "restored " + saved.value);
  std::memcpy(staging.mapped().data(), saved.texels.data(), saved.texels.size());
  device.run_commands([&](VkCommandBuffer commands) {
    gpu::record_full_barrier(commands);
    gpu::record_buffer_to_image(commands, staging.get(), 0, *layer.image, gpu::whole_level(*layer.image, layer.layer),
                                VK_IMAGE_LAYOUT_GENERAL);
    gpu::record_full_barrier(commands);
  });
}

}  // namespace

std::vector<SavedLayer> save_layers(gpu::Device& device, const Graph& graph, const ValueImages& images,
                                    uint64_t frame_count) {
  std::vector<SavedLayer> layers;
  for (const LayerKey& key : layers_to_keep(graph)) {
    const Value& value = graph.values[key.value];
    const ValueLayer layer = images.layer(key.value, key.age, frame_count - 1);
    layers.push_back({value_name(value), key.age, value.desc,
                      gpu::read_image(device, *layer.image, gpu::whole_level(*layer.image, layer.layer))});
  }
  return layers;
}

void restore_layers(gpu::Device& device, const Graph& graph, const ValueImages& images, uint64_t frame_count,
                    const std::vector<SavedLayer>& layers) {
  const std::vector<LayerKey> keys = layers_to_keep(graph);
  bool same = keys.size() == layers.size();
  for (size_t i = 0; same && i < keys.size(); ++i) {
    const Value& value = graph.values[keys[i].value];
    same = value_name(value) == layers[i].value && keys[i].age == layers[i].age && value.desc == layers[i].desc &&
           layers[i].texels.size() == byte_size(value.desc);
  }
  if (!same) throw Error(ExitCode::invalid_input, "the saved histories are not those of this graph");
  for (size_t i = 0; i < keys.size(); ++i)
    upload_layer(device, images.layer(keys[i].value, keys[i].age, frame_count - 1), layers[i]);
}

}  // namespace lightloom::run
