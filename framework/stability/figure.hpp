#pragma once

#include <cstdint>
#include <string>

namespace lightloom::stability {

/// How a value must stand to its threshold.
enum class Relation : uint8_t { at_most, at_least, equal };

/// One measured number beside the bound it must keep.
struct Figure {
  std::string what;  ///< "largest relative difference, scale 1e-6"
  double value = 0;
  Relation relation = Relation::at_most;
  double threshold = 0;
  std::string unit;  ///< "relative", "dB", "pixels"; empty for counts and ratios
};

/// False for a value that is not a number, whatever the relation.
[[nodiscard]] bool holds(const Figure& figure);

/// "<=", ">=", "=".
[[nodiscard]] std::string to_string(Relation relation);

// Shorthand for the rows of a check.
[[nodiscard]] Figure at_most(std::string what, double value, double threshold, std::string unit = {});
[[nodiscard]] Figure at_least(std::string what, double value, double threshold, std::string unit = {});
[[nodiscard]] Figure equal(std::string what, double value, double threshold, std::string unit = {});
/// A number of differing things, which must be 0.
[[nodiscard]] Figure none(std::string what, double count);

}  // namespace lightloom::stability
