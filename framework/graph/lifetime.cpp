#include "framework/graph/lifetime.hpp"

#include <algorithm>

namespace lightloom {
namespace {

std::vector<bool> written_once(const Plan& plan) {
  std::vector<bool> once(plan.graph.values.size(), false);
  for (const PlanStep& step : plan.once)
    for (const auto* uses : {&plan.graph.passes[step.pass].outputs, &plan.graph.passes[step.pass].scratch})
      for (const Use& use : *uses) once[use.value] = true;
  return once;
}

Keeping keeping_of(const Value& value, bool once) {
  if (value.constant) return Keeping::constant;
  if (once) return Keeping::once;
  if (value.history > 0) return Keeping::history;
  return value.persistent ? Keeping::persistent : Keeping::frame;
}

}  // namespace

std::string_view to_string(Keeping keeping) {
  switch (keeping) {
    case Keeping::frame:
      return "frame";
    case Keeping::history:
      return "history";
    case Keeping::persistent:
      return "persistent";
    case Keeping::once:
      return "once";
    case Keeping::constant:
      break;
  }
  return "constant";
}

std::vector<Lifetime> lifetimes(const Plan& plan) {
  const std::vector<bool> once = written_once(plan);
  std::vector<Lifetime> lives(plan.graph.values.size());
  for (ValueId value = 0; value < lives.size(); ++value)
    lives[value].keeping = keeping_of(plan.graph.values[value], once[value]);
  for (uint32_t index = 0; index < plan.steps.size(); ++index) {
    const auto touch = [&](ValueId value) {
      if (!lives[value].first) lives[value].first = index;
      lives[value].last = index;
    };
    const GraphPass& pass = plan.graph.passes[plan.steps[index].pass];
    for (const auto* uses : {&pass.inputs, &pass.outputs, &pass.scratch})
      for (const Use& use : *uses) touch(use.value);
    for (const Observation& observation : plan.steps[index].observations) touch(observation.value);
  }
  return lives;
}

}  // namespace lightloom
