#pragma once

#include <string>

#include "framework/graph/graph.hpp"

namespace lightloom::run {

/// What the port table of the pass that makes a value says of it; empty for a value that no pass makes.
[[nodiscard]] std::string value_doc(const Graph& graph, const Value& value);

}  // namespace lightloom::run
