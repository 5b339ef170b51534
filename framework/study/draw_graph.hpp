#pragma once

#include "framework/graph/plan.hpp"
#include "framework/study/results.hpp"

namespace lightloom::study {

/// Passes in execution order, and the edges between them; edges of one pair and age are one, with all their ports.
void draw_graph(const Plan& plan, StudyResults& results);

}  // namespace lightloom::study
