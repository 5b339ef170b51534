#include "framework/run/value_marks.hpp"

#include <algorithm>

namespace lightloom::run {

ValueMarks::ValueMarks(const Plan& plan) : graph_(plan.graph), every_frame_(graph_.values.size()) {
  for (const Value& value : graph_.values)
    marks_.emplace_back(static_cast<size_t>(ring_layers(value)) + (value.persistent ? 1 : 0), false);
  for (const PlanStep& step : plan.steps) {
    const GraphPass& pass = graph_.passes[step.pass];
    for (const auto* uses : {&pass.outputs, &pass.scratch})
      for (const Use& use : *uses) every_frame_[use.value] = true;
  }
}

void ValueMarks::begin_frame() {
  for (ValueId value = 0; value < marks_.size(); ++value) {
    if (!every_frame_[value]) continue;
    marks_[value].push_front(false);
    marks_[value].pop_back();
  }
}

void ValueMarks::mark(ValueId value, uint32_t age) {
  std::deque<bool>& ages = marks_.at(value);
  if (age < ages.size()) ages[age] = true;
}

bool ValueMarks::marked(ValueId value, uint32_t age) const {
  const std::deque<bool>& ages = marks_.at(value);
  // A constant has one layer, whatever the age.
  return ages[std::min<size_t>(age, ages.size() - 1)];
}

bool ValueMarks::reads_marked(const GraphPass& pass) const {
  for (const Use& use : pass.inputs)
    for (uint32_t age = use.first_age; age <= use.last_age; ++age)
      if (marked(use.value, age)) return true;
  for (const auto* uses : {&pass.outputs, &pass.scratch})
    for (const Use& use : *uses)
      if (graph_.values[use.value].persistent && every_frame_[use.value] && marked(use.value, 1)) return true;
  return false;
}

std::vector<ValueId> ValueMarks::marked_now() const {
  std::vector<ValueId> values;
  for (ValueId value = 0; value < marks_.size(); ++value)
    if (marks_[value].front()) values.push_back(value);
  return values;
}

}  // namespace lightloom::run
