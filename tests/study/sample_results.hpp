#pragma once

#include <filesystem>
#include <string>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// An ablation of the paper's graph as a study would give it, with figures made up but plausible: two views, five
/// seeds, a failed row, an infinite PSNR. Writes its pictures into `folder`/pictures.
[[nodiscard]] StudyResults sample_results(const std::filesystem::path& folder);

/// `count` rows of one view, in one picture.
[[nodiscard]] StudyResults many_rows(const std::filesystem::path& folder, size_t count);

/// Names made of markup, quotes, script ends and line separators, all of them very long or very odd.
[[nodiscard]] StudyResults hostile_results(const std::filesystem::path& folder);

}  // namespace lightloom::study
