#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/study/study_spec.hpp"

namespace lightloom::study {

/// One way to render: the study's changes and then its own.
struct Setting {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;  ///< by axis
  Changes changes;
  SourceLocation where;
};

struct Settings {
  std::vector<std::string> axes;  ///< of `values`, in order
  std::vector<Setting> list;      ///< the baseline first; names are unique
};

constexpr size_t kMostSettings = 1024;

/// Variants and ablations (each matched pass off alone; for a factorial study every combination of them) times the
/// sweep (every combination, or one axis at a time, the others at their first value). `passes` are those that run and
/// may be ablated. Reports globs that match none of them, and more settings than kMostSettings.
[[nodiscard]] std::optional<Settings> expand_settings(const StudySpec& spec, const std::vector<std::string>& passes,
                                                      Diagnostics& diagnostics);

}  // namespace lightloom::study
