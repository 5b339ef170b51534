#pragma once

#include <string>
#include <string_view>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// Three significant digits, whatever the locale: 0.0712, 12.3, 1234, 1.2e-05; ∞, −∞ and "not a number" in words.
[[nodiscard]] std::string format_number(double value);

/// The study's outcome in words, as HTML: how many settings, seeds and views; for each view the best by the study's
/// metric, the fastest, and which settings cannot be told from the baseline; then what failed.
[[nodiscard]] std::string summary_html(const StudyResults& results);

}  // namespace lightloom::study
