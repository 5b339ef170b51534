#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/cli/comparison.hpp"

namespace lightloom::cli {

/// The figures of `names` (all of them if empty), in the order of image::kNamedMetrics; null for what is not finite.
/// A sequence has their means over frames, flicker, and `frames`.
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison,
                                                     const std::vector<std::string>& names);

/// The same for people.
[[nodiscard]] std::string comparison_text(const Comparison& comparison, const std::vector<std::string>& names,
                                          const image::MetricOptions& options);

}  // namespace lightloom::cli
