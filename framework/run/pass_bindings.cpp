#include "framework/run/pass_bindings.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace lightloom::run {
namespace {

ShaderValue shader_value(const ParamSet& params, const ParamSet::Entry& entry) {
  const std::string& name = entry.param->name;
  switch (entry.param->type) {
    case ParamType::boolean:
      return {name, params.boolean(name)};
    case ParamType::integer:
      return {name, static_cast<int32_t>(params.integer(name))};
    case ParamType::real:
      return {name, static_cast<float>(params.real(name))};
    case ParamType::choice:
      return {name, params.choice_index(name)};
  }
  throw Error(ExitCode::run_failed, "param '" + name + "' has no known type");
}

/// How an image of the pass's shaders is stored. Nothing is read of what is not there, but shaders that could read it
/// are compiled all the same.
std::optional<Format> format_of(const GraphPass& pass, const std::vector<Value>& graph_values, std::string_view image) {
  for (const std::vector<Use>* uses : {&pass.inputs, &pass.outputs, &pass.scratch})
    for (const Use& use : *uses)
      if (use.shader_name == image) return graph_values[use.value].desc.format;
  for (const std::string& port : pass.unconnected)
    for (const PortPart& part : pass.type->find_port(port, Direction::in)->parts)
      if (image == (part.name.empty() ? port : port + "_" + part.name)) return part.format;
  return std::nullopt;
}

}  // namespace

gpu::ResourceMap port_resources(const GraphPass& pass, const ValueImages& images, uint64_t frame_count) {
  gpu::ResourceMap resources;
  for (const Use& use : pass.inputs) {
    const gpu::ImageView view =
        use.array ? images.array_view(use.value) : images.view(use.value, use.first_age, frame_count);
    resources.emplace(use.shader_name, gpu::resource(view));
  }
  for (const std::vector<Use>* uses : {&pass.outputs, &pass.scratch})
    for (const Use& use : *uses)
      resources.emplace(use.shader_name, gpu::resource(images.view(use.value, 0, frame_count)));
  return resources;
}

std::vector<ShaderValue> known_shader_values(const GraphPass& pass, const ValueImages& images, uint64_t frame_count,
                                             const std::vector<ShaderValue>& scene_values) {
  std::vector<ShaderValue> values;
  for (const ParamSet::Entry& entry : pass.params.entries()) values.push_back(shader_value(pass.params, entry));
  values.insert(values.end(), scene_values.begin(), scene_values.end());
  for (const Use& use : pass.inputs) {
    if (!use.array) continue;
    values.push_back({use.port + "_count", use.last_age - use.first_age + 1});
    values.push_back({use.port + "_first_age", use.first_age});
    values.push_back({use.port + "_ring", images.ring(use.value)});
    values.push_back({use.port + "_newest_layer", images.newest(use.value, frame_count)});
  }
  for (const Port& port : pass.type->ports) {
    if (port.direction != Direction::in || !port.optional) continue;
    const auto& missing = pass.unconnected;
    const bool bound = std::find(missing.begin(), missing.end(), port.name) == missing.end();
    values.push_back({port.name + "_bound", bound});
    if (bound || !port.array) continue;
    values.push_back({port.name + "_count", 0u});
    values.push_back({port.name + "_first_age", 0u});
    values.push_back({port.name + "_ring", 1u});
    values.push_back({port.name + "_newest_layer", 0u});
  }
  return values;
}

std::optional<ShaderValue> storage_value(const GraphPass& pass, const std::vector<Value>& graph_values,
                                         std::string_view name) {
  constexpr std::string_view kLargest = "_largest", kBits = "_bits";
  const bool largest = name.ends_with(kLargest);
  if (!largest && !name.ends_with(kBits)) return std::nullopt;
  const std::optional<Format> format =
      format_of(pass, graph_values, name.substr(0, name.size() - (largest ? kLargest : kBits).size()));
  if (!format) return std::nullopt;
  return largest ? ShaderValue{std::string(name), largest_number(*format)}
                 : ShaderValue{std::string(name), channel_bits(*format)};
}

std::vector<ShaderValue> specialization_values(const gpu::Reflection& reflection,
                                               const std::vector<ShaderValue>& values) {
  std::vector<ShaderValue> chosen;
  for (const gpu::SpecializationConstant& constant : reflection.constants) {
    const auto found = std::find_if(values.begin(), values.end(),
                                    [&](const ShaderValue& value) { return value.name == constant.name; });
    if (found != values.end()) chosen.push_back(*found);
  }
  return chosen;
}

bool names_unconnected_input(const GraphPass& pass, std::string_view binding) {
  return std::any_of(pass.unconnected.begin(), pass.unconnected.end(), [&](const std::string& port_name) {
    const Port* port = pass.type->find_port(port_name, Direction::in);
    if (port == nullptr) return false;
    return std::any_of(port->parts.begin(), port->parts.end(), [&](const PortPart& part) {
      return binding == (part.name.empty() ? port->name : port->name + "_" + part.name);
    });
  });
}

}  // namespace lightloom::run
