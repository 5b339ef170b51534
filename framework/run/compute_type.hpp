#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "framework/base/diagnostics.hpp"
#include "framework/gpu/reflection.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/pass_type.hpp"

namespace lightloom::run {

/// The compiled shader of a node of type `compute`.
struct ComputeShader {
  std::string file;  ///< whole path
  gpu::Reflection reflection;
  uint64_t identity = 0;  ///< hash of its SPIR-V
  /// Where it declares a name: "file:line".
  std::function<std::string(std::string_view name)> place;
};

/// What else the type follows from.
struct ComputeNode {
  const PassSpec& pass;                         ///< with `compute`
  const std::vector<ScalarSpec>& graph_params;  ///< that its params may refer to
  std::map<std::string, std::string> bundles;   ///< type of the bundle that an input of this name is connected to
};

/// The pass type that a shader and its node make together. Names are the interface (port.hpp, pass_context.hpp):
/// - Sampled images are inputs, `texture2DArray` a history range, an image `readonly` an input that is loaded; parts
///   of a bundle `surface` are `surface_normal` and the like; an input P is optional if there is a constant `P_bound`.
/// - An image `out_P` is the output P. Its format is what the shader names or the node, rgba32_sfloat if neither does;
///   its size what the node says, else that of the input P, of the node's first input of the same dimension, or the
///   view's.
/// - Constants that the framework does not provide are params: push constants need a value in the node,
///   specialization constants have the shader's as default.
/// - What it reads of scene and frame is what its code names.
/// Where the two do not fit, reports it and returns nothing.
[[nodiscard]] std::optional<PassType> make_compute_type(const ComputeNode& node, const ComputeShader& shader,
                                                        Diagnostics& diagnostics);

}  // namespace lightloom::run
