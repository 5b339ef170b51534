#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/param.hpp"

// Shorthand for the rows of a param table. `value` is the default; bounds are included, {} is none.
namespace lightloom::passes {

inline Param real_param(std::string name, double value, std::optional<double> minimum, std::optional<double> maximum,
                        std::string unit, std::string doc) {
  return {std::move(name), ParamType::real, value, minimum, maximum, {}, std::move(unit), std::move(doc)};
}

inline Param integer_param(std::string name, int64_t value, std::optional<double> minimum,
                           std::optional<double> maximum, std::string unit, std::string doc) {
  return {std::move(name), ParamType::integer, value, minimum, maximum, {}, std::move(unit), std::move(doc)};
}

inline Param boolean_param(std::string name, bool value, std::string doc) {
  return {std::move(name), ParamType::boolean, value, {}, {}, {}, "", std::move(doc)};
}

/// The shader sees the index of the choice.
inline Param choice_param(std::string name, std::string value, std::vector<std::string> choices, std::string doc) {
  return {std::move(name), ParamType::choice, std::move(value), {}, {}, std::move(choices), "", std::move(doc)};
}

}  // namespace lightloom::passes
