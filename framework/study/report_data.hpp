#pragma once

#include <filesystem>
#include <string>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// What the report's script reads, as JSON that may stand inside an HTML script element: no `<`, `>`, `&`, U+2028 or
/// U+2029 is left in it. Infinite numbers and NaN are the strings "inf", "-inf", "nan". Pictures are base64 in the
/// array `pictures`, equal ones once, and named by index. Throws Error (run_failed) for a picture that cannot be read.
[[nodiscard]] std::string report_data(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace lightloom::study
