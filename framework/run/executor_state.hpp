#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/graph.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// One layer of a value that the next frames may read.
struct SavedLayer {
  std::string value;  ///< "pass.port[.part]"
  uint32_t age = 0;   ///< 0: of the last frame
  ImageDesc desc;
  std::vector<std::byte> texels;  ///< tightly packed
};

/// All that crosses from one frame to the next, but for what follows from the scene and the frames' numbers.
struct ExecutorState {
  uint64_t frame_count = 0;             ///< frames run
  std::vector<uint32_t> recent_frames;  ///< numbers of the last of them, oldest first; as many as the scene remembers
  std::vector<SavedLayer> layers;       ///< of history rings and persistent values
};

/// Texels of one layer of a value, given from outside.
struct GivenLayer {
  ValueId value = 0;
  uint32_t age = 0;               ///< 0: of the frame that begins
  std::vector<std::byte> texels;  ///< tightly packed
};

/// Where an executor begins that is to run one frame of a run, or a part of it.
struct FrameStart {
  uint64_t frame_count = 0;             ///< frames before it
  std::vector<uint32_t> recent_frames;  ///< numbers of the last of them, oldest first; as many as the scene remembers
  std::vector<GivenLayer> layers;       ///< of histories, and of values that stand as constants (graph/cut.hpp)
};

/// Reads them back from the device; `frame_count` frames, at least one, have run.
[[nodiscard]] std::vector<SavedLayer> save_layers(gpu::Device& device, const Graph& graph, const ValueImages& images,
                                                  uint64_t frame_count);
/// Writes them where they were. Throws Error(invalid_input) if they are not those of this graph.
void restore_layers(gpu::Device& device, const Graph& graph, const ValueImages& images, uint64_t frame_count,
                    const std::vector<SavedLayer>& layers);

/// Writes the layers where the frame that begins looks for them. Throws Error(invalid_input) if one has not the bytes
/// of its value.
void give_layers(gpu::Device& device, const Graph& graph, const ValueImages& images, const FrameStart& start);

}  // namespace lightloom::run
