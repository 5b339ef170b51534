#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"

namespace lightloom {

/// JSON Schema (2020-12) of graph files: the format's keys, and of each pass type its inputs and params with types,
/// ranges, choices, defaults, units and docs. `scene_features` is what `when` may name. It accepts every file that
/// parse_graph and link accept; what takes more than one place of the file to see (names that lead nowhere, shapes,
/// cycles) it cannot refuse.
[[nodiscard]] nlohmann::ordered_json graph_schema(const PassRegistry& registry,
                                                  const std::vector<std::string>& scene_features);

}  // namespace lightloom
