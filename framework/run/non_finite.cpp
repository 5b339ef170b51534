#include "framework/run/non_finite.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/text.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/texel_text.hpp"

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;

bool all_finite(const SavedLayer& layer) {
  const image::ChannelType type = image::channel_type(layer.desc.format);
  if (type != image::ChannelType::float32 && type != image::ChannelType::half) return true;
  const image::HostImage image{layer.desc, layer.texels};
  const Extent3& extent = layer.desc.extent;
  for (uint32_t z = 0; z < extent.depth; ++z)
    for (uint32_t y = 0; y < extent.height; ++y)
      for (uint32_t x = 0; x < extent.width; ++x)
        for (uint32_t channel = 0; channel < format_info(layer.desc.format).channels; ++channel)
          if (!std::isfinite(image.at(x, y, z, channel))) return false;
  return true;
}

bool has_any(const ScannedValue& seen) {
  return seen.nan_texels > 0 || seen.infinite_texels > 0;
}

std::string counts(const NonFinite& made) {
  std::vector<std::string> parts;
  if (made.seen.nan_texels > 0) parts.push_back("NaN in " + std::to_string(made.seen.nan_texels));
  if (made.seen.infinite_texels > 0) parts.push_back("infinity in " + std::to_string(made.seen.infinite_texels));
  return join(parts, " and ") + " of " + std::to_string(texel_count(made.desc)) + " texels";
}

std::vector<std::string> input_names(const Graph& graph, const GraphPass& pass) {
  std::vector<std::string> names;
  for (const Use& use : pass.inputs) {
    std::string name = value_name(graph.values[use.value]);
    if (use.last_age > 0) name += "@" + std::to_string(use.first_age);
    if (use.last_age > use.first_age) name += ".." + std::to_string(use.last_age);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

NonFiniteWatch::NonFiniteWatch(const Plan& plan) : plan_(plan), marks_(plan) {
  for (ValueId value = 0; value < plan.graph.values.size(); ++value) {
    const std::optional<ClearColor>& constant = plan.graph.values[value].constant;
    if (constant &&
        !std::all_of(constant->begin(), constant->end(), [](float channel) { return std::isfinite(channel); }))
      marks_.mark(value);
  }
}

void NonFiniteWatch::resume(const ExecutorState& state) {
  for (const SavedLayer& layer : state.layers)
    for (ValueId value = 0; value < plan_.graph.values.size(); ++value)
      if (value_name(plan_.graph.values[value]) == layer.value && !all_finite(layer)) marks_.mark(value, layer.age);
}

void NonFiniteWatch::add(uint32_t frame, std::span<const ScannedValue> scanned) {
  marks_.begin_frame();
  // Scans come in the order of the passes, a pass's together.
  for (const auto* steps : {&plan_.once, &plan_.steps})
    for (const PlanStep& step : *steps) look_at(frame, plan_.graph.passes[step.pass], scanned);
}

void NonFiniteWatch::look_at(uint32_t frame, const GraphPass& pass, std::span<const ScannedValue> scanned) {
  const bool had_it = marks_.reads_marked(pass);
  for (const auto* uses : {&pass.outputs, &pass.scratch})
    for (const Use& use : *uses) {
      const auto seen = std::find_if(scanned.begin(), scanned.end(),
                                     [&](const ScannedValue& candidate) { return candidate.value == use.value; });
      if (seen == scanned.end() || !has_any(*seen)) continue;
      marks_.mark(use.value);
      if (had_it)
        passed_on_.insert(value_name(plan_.graph.values[use.value]));
      else
        name(frame, pass, *seen);
    }
}

void NonFiniteWatch::name(uint32_t frame, const GraphPass& pass, const ScannedValue& seen) {
  const Value& value = plan_.graph.values[seen.value];
  const auto known =
      std::find_if(found_.begin(), found_.end(), [&](const NonFinite& made) { return made.seen.value == seen.value; });
  if (known != found_.end()) {
    known->frames.add(frame);
    return;
  }
  found_.push_back({.pass = pass.name,
                    .value = value_name(value),
                    .seen = seen,
                    .frames = {},
                    .desc = value.desc,
                    .inputs = input_names(plan_.graph, pass)});
  found_.back().frames.add(frame);
}

std::vector<std::string> NonFiniteWatch::warnings() const {
  std::vector<std::string> sentences;
  for (const NonFinite& made : found_) {
    const std::string read =
        made.inputs.empty() ? "it reads no other value" : "all that it read was finite: " + join(made.inputs, ", ");
    sentences.push_back(made.value + ": " + made.pass + " made " + counts(made) + ", first at " +
                        texel_place(made.desc, *made.seen.first_bad) + ", " + texel_text(made.desc, made.seen.texel) +
                        "; " + made.frames.text() + "; " + read);
  }
  return sentences;
}

Json NonFiniteWatch::record() const {
  Json made = Json::array();
  for (const NonFinite& one : found_) {
    made.push_back({{"value", one.value},
                    {"pass", one.pass},
                    {"frames", one.frames.json()},
                    {"nan_texels", one.seen.nan_texels},
                    {"infinite_texels", one.seen.infinite_texels},
                    {"texels", texel_count(one.desc)},
                    {"first", texel_coordinates(one.desc, *one.seen.first_bad)},
                    {"texel", channel_texts(one.desc, one.seen.texel)},
                    {"finite_inputs", one.inputs}});
  }
  return {{"made", made}, {"passed_on", passed_on_}};
}

}  // namespace lightloom::run
