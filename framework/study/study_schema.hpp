#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lightloom::study {

/// JSON Schema (2020-12) of study files, with what parse_study accepts: keys, types, ranges, choices and defaults.
[[nodiscard]] nlohmann::ordered_json study_schema();

}  // namespace lightloom::study
