#include <algorithm>

#include "framework/base/hash.hpp"
#include "framework/graph/plan.hpp"

namespace lightloom {
namespace {

/// Feeds a hash with what is executed; values go in by name and shape, since ids depend on the file's order.
class PlanHasher {
 public:
  explicit PlanHasher(const Plan& plan) : plan_(plan) {}

  uint64_t run() {
    for (const Clear& clear : plan_.prologue) {
      value(clear.value);
      for (const float channel : clear.color) hasher_.real(channel);
    }
    barriers(plan_.prologue_barriers);
    steps(plan_.once);
    barriers(plan_.once_barriers);
    barriers(plan_.frame_start);
    barriers(plan_.inputs_ready);
    observations(plan_.opening_observations);
    steps(plan_.steps);
    hasher_.number(plan_.graph.outputs.size());
    for (const GraphOutput& output : plan_.graph.outputs) {
      hasher_.text(output.name);
      value(output.value);
      hasher_.number(output.age);
    }
    if (plan_.graph.general) hasher_.text("general");  // other constants in the shaders
    return hasher_.value();
  }

 private:
  void steps(const std::vector<PlanStep>& list) {
    hasher_.number(list.size());
    for (const PlanStep& step : list) {
      barriers(step.barriers);
      pass(plan_.graph.passes[step.pass]);
      observations(step.observations);
    }
  }

  void value(ValueId id) {
    if (id == kFrameInputs || id == kEverything) return hasher_.text(barrier_subject(plan_.graph, id));
    const Value& value = plan_.graph.values[id];
    hasher_.text(value_name(value));
    hasher_.text(to_string(value.desc));
    hasher_.number(ring_layers(value));
    hasher_.number(value.persistent);
    hasher_.number(value.constant.has_value());
    for (const float channel : value.constant.value_or(ClearColor{})) hasher_.real(channel);
  }

  void uses(const std::vector<Use>& list) {
    hasher_.number(list.size());
    for (const Use& use : list) {
      hasher_.text(use.shader_name);
      hasher_.number(static_cast<uint64_t>(use.access));
      value(use.value);
      hasher_.number(use.first_age);
      hasher_.number(use.last_age);
      hasher_.number(use.array);
    }
  }

  void pass(const GraphPass& pass) {
    hasher_.text(pass.name);
    hasher_.text(pass.type->name);
    hasher_.number(pass.type->version);
    hasher_.number(pass.params.entries().size());
    for (const ParamSet::Entry& entry : pass.params.entries()) {
      hasher_.text(entry.param->name);
      hasher_.text(to_string(entry.value));
    }
    uses(pass.inputs);
    uses(pass.outputs);
    uses(pass.scratch);
  }

  void barriers(const std::vector<Barrier>& list) {
    // Who shares memory with whom is the device's affair, not the graph's.
    const auto counts = [](const Barrier& barrier) { return !barrier.takes_over; };
    hasher_.number(static_cast<uint64_t>(std::count_if(list.begin(), list.end(), counts)));
    for (const Barrier& barrier : list) {
      if (!counts(barrier)) continue;
      value(barrier.value);
      hasher_.number(static_cast<uint64_t>(barrier.from));
      hasher_.number(static_cast<uint64_t>(barrier.to));
      hasher_.number(static_cast<uint64_t>(barrier.hazard));
      hasher_.number(barrier.previous_frame);
    }
  }

  void observations(const std::vector<Observation>& list) {
    hasher_.number(list.size());
    for (const Observation& observation : list) {
      value(observation.value);
      hasher_.number(observation.age);
      hasher_.number(static_cast<uint64_t>(observation.observer));
      barriers(observation.barriers);
    }
  }

  const Plan& plan_;
  Hasher hasher_;
};

}  // namespace

uint64_t plan_hash(const Plan& plan) {
  return PlanHasher(plan).run();
}

}  // namespace lightloom
