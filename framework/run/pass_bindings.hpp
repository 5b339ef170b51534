#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/reflection.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/pass_context.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// The images of a pass's ports by shader name (rules in port.hpp), as they are in frame number `frame_count`.
[[nodiscard]] gpu::ResourceMap port_resources(const GraphPass& pass, const ValueImages& images, uint64_t frame_count);

/// The values that a shader may name without the pass giving them (pass_context.hpp): params, what the scene offers,
/// and for history ranges and optional inputs what the linker found.
[[nodiscard]] std::vector<ShaderValue> known_shader_values(const GraphPass& pass, const ValueImages& images,
                                                           uint64_t frame_count,
                                                           const std::vector<ShaderValue>& scene_values);

/// NAME_largest or NAME_bits of an image that the pass's shaders call NAME (pass_context.hpp); empty for other names.
[[nodiscard]] std::optional<ShaderValue> storage_value(const GraphPass& pass, const std::vector<Value>& graph_values,
                                                       std::string_view name);

/// Those of `values` that are specialization constants of the shader.
[[nodiscard]] std::vector<ShaderValue> specialization_values(const gpu::Reflection& reflection,
                                                             const std::vector<ShaderValue>& values);

/// Whether `binding` is the shader name of an optional input of the pass that is not connected.
[[nodiscard]] bool names_unconnected_input(const GraphPass& pass, std::string_view binding);

}  // namespace lightloom::run
