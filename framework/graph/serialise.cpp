#include "framework/graph/serialise.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace lightloom {
namespace {

Barrier after_everything(std::string_view what) {
  return {.value = kEverything,
          .from = Access::anything,
          .to = Access::anything,
          .hazard = Hazard::write_after_write,
          .previous_frame = false,
          .reason = std::string(what) + " waits for all before, whether it must or not"};
}

void serialise_all(std::vector<Observation>& observations) {
  for (Observation& observation : observations)
    observation.barriers.push_back(after_everything(to_string(observation.observer)));
}

void serialise_all(std::vector<PlanStep>& steps) {
  for (PlanStep& step : steps) {
    step.barriers.push_back(after_everything("the pass"));
    serialise_all(step.observations);
  }
}

}  // namespace

void serialise(Plan& plan) {
  if (!plan.prologue.empty()) plan.prologue_barriers.push_back(after_everything("the first frame"));
  plan.frame_start.push_back(after_everything("the upload"));
  plan.inputs_ready.push_back(after_everything("what reads the frame inputs"));
  serialise_all(plan.once);
  serialise_all(plan.opening_observations);
  serialise_all(plan.steps);
}

}  // namespace lightloom
