#pragma once

#include <filesystem>
#include <string>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// One self-contained HTML page: the pictures that `results` names, relative to `folder`, are embedded. It asks nothing
/// of a network. Throws Error (run_failed) for a picture that cannot be read.
[[nodiscard]] std::string make_report(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace lightloom::study
