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

void upload_layer(gpu::Device& device, const ValueLayer& layer, const std::vector<std::byte>& texels) {
  const gpu::Buffer staging(device, texels.size(), 0, gpu::MemoryKind::upload, "texels of " + layer.image->spec().name);
  std::memcpy(staging.mapped().data(), texels.data(), texels.size());
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
    upload_layer(device, images.layer(keys[i].value, keys[i].age, frame_count - 1), layers[i].texels);
}

void give_layers(gpu::Device& device, const Graph& graph, const ValueImages& images, const FrameStart& start) {
  for (const GivenLayer& given : start.layers) {
    const Value& value = graph.values.at(given.value);
    if (given.texels.size() != byte_size(value.desc))
      throw Error(ExitCode::invalid_input,
                  "what is given as " + value_name(value) + " has " + std::to_string(given.texels.size()) +
                      " bytes, and " + to_string(value.desc) + " takes " + std::to_string(byte_size(value.desc)));
    upload_layer(device, images.layer(given.value, given.age, start.frame_count), given.texels);
  }
}

}  // namespace lightloom::run
