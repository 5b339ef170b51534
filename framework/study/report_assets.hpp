#pragma once

#include <string_view>

namespace lightloom::study {

/// The parts of the report that are the same for all studies, embedded at build from framework/study/report.
[[nodiscard]] std::string_view report_page();    ///< HTML with places {{name}} that make_report fills
[[nodiscard]] std::string_view report_style();   ///< CSS
[[nodiscard]] std::string_view report_script();  ///< one JavaScript module

}  // namespace lightloom::study
