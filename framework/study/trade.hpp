#pragma once

#include <vector>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// Rows of one scene and camera that differ in one axis alone, whose values are numbers: a curve of error over time.
/// Made from all rows without an error. Rows that belong to no such curve are not in any.
struct Curve {
  std::string axis;
  std::vector<const Row*> rows;  ///< by ascending value of the axis
  std::vector<double> values;    ///< parallel to `rows`
};
[[nodiscard]] std::vector<Curve> find_curves(const StudyResults& results);

/// What each curve's error is at the time of each of the baseline's rows, and its time at their error: the targets are
/// the rows of the curves that begin with the baseline, or the baseline alone. Between two neighbours of a curve it is
/// interpolated along a straight line of logarithms, where the curve gets there first; nothing is extrapolated. Error
/// is `results.metric`.
void fill_trade_tables(StudyResults& results);

}  // namespace lightloom::study
