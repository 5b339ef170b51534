#include "framework/run/poison_check.hpp"

#include <algorithm>
#include <map>

#include "framework/run/texel_text.hpp"

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;

std::map<ValueId, const ScannedValue*> by_value(std::span<const ScannedValue> scanned) {
  std::map<ValueId, const ScannedValue*> found;
  for (const ScannedValue& seen : scanned) found[seen.value] = &seen;
  return found;
}

}  // namespace

void PoisonCheck::add(uint32_t frame, std::span<const ScannedValue> nan_run, std::span<const ScannedValue> number_run) {
  marks_.begin_frame();
  const std::map<ValueId, const ScannedValue*> one = by_value(nan_run);
  const std::map<ValueId, const ScannedValue*> other = by_value(number_run);
  for (const auto* steps : {&plan_.once, &plan_.steps})
    for (const PlanStep& step : *steps) {
      const GraphPass& pass = plan_.graph.passes[step.pass];
      const bool had_it = marks_.reads_marked(pass);
      // Not scratch: what a pass leaves there unwritten, and does not read, does no harm.
      for (const Use& use : pass.outputs) {
        const auto seen = one.find(use.value);
        if (seen == one.end() || seen->second->digest == other.at(use.value)->digest) continue;
        marks_.mark(use.value);
        if (!had_it) name(frame, pass, *seen->second, *other.at(use.value));
      }
    }
}

void PoisonCheck::name(uint32_t frame, const GraphPass& pass, const ScannedValue& nan_run,
                       const ScannedValue& number_run) {
  const auto known = std::find_if(found_.begin(), found_.end(),
                                  [&](const Unwritten& unwritten) { return unwritten.id == nan_run.value; });
  if (known != found_.end()) {
    known->frames.add(frame);
    return;
  }
  const Value& value = plan_.graph.values[nan_run.value];
  // A texel may hold one run's poison for another reason, such as a NaN that was passed on; hardly that of both.
  found_.push_back({.pass = pass.name,
                    .id = nan_run.value,
                    .value = value_name(value),
                    .desc = value.desc,
                    .texels = std::min(nan_run.poison_texels, number_run.poison_texels),
                    .first = std::max(nan_run.first_poison.value_or(0), number_run.first_poison.value_or(0)),
                    .frames = {}});
  found_.back().frames.add(frame);
}

std::vector<std::string> PoisonCheck::complaints() const {
  std::vector<std::string> sentences;
  for (const Unwritten& unwritten : found_) {
    const std::string what =
        unwritten.texels == 0
            ? unwritten.pass + " makes it of what nobody wrote: it reads an output or scratch before it writes there"
            : unwritten.pass + " leaves " + std::to_string(unwritten.texels) + " of " +
                  std::to_string(texel_count(unwritten.desc)) + " texels unwritten, first " +
                  texel_place(unwritten.desc, unwritten.first);
    sentences.push_back(unwritten.value + ": " + what + "; " + unwritten.frames.text());
  }
  return sentences;
}

Json PoisonCheck::record() const {
  Json list = Json::array();
  for (const Unwritten& unwritten : found_) {
    Json entry = {{"value", unwritten.value},
                  {"pass", unwritten.pass},
                  {"frames", unwritten.frames.json()},
                  {"unwritten_texels", unwritten.texels},
                  {"texels", texel_count(unwritten.desc)}};
    if (unwritten.texels > 0) entry["first"] = texel_coordinates(unwritten.desc, unwritten.first);
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace lightloom::run
