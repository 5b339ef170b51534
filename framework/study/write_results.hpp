#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/study/evaluate.hpp"
#include "framework/study/results.hpp"

namespace lightloom::study {

/// Whether what depends on a clock is written: times, their verdicts, the Pareto front, the trade tables. Without it,
/// equal studies on one device give equal files.
enum class Times : uint8_t { with, without };

/// One line a row (RFC 4180). The columns are in docs/studies.md.
[[nodiscard]] std::string results_csv(const StudyResults& results, Times times);
/// One line a cell: a setting in a view with a seed.
[[nodiscard]] std::string cells_csv(const StudyResults& results, const std::vector<CellResult>& cells, Times times);
/// Everything; what is not finite is null.
[[nodiscard]] std::string results_json(const StudyResults& results, Times times);

/// results.csv, cells.csv, results.json and, with times, report.html; each whole or not at all. Throws
/// Error(run_failed).
void write_results(const StudyResults& results, const std::vector<CellResult>& cells,
                   const std::filesystem::path& folder, Times times);

/// The words as a shell takes them, quoted where they must be.
[[nodiscard]] std::string shell_text(const std::vector<std::string>& words);

}  // namespace lightloom::study
