#pragma once

#include <string_view>

namespace lightloom::page {

/// The parts of a plan's page that are the same for all plans, embedded at build from framework/page/plan and /shared.
[[nodiscard]] std::string_view plan_page();    ///< HTML with places {{name}} that make_plan_page fills
[[nodiscard]] std::string_view plan_style();   ///< CSS
[[nodiscard]] std::string_view plan_script();  ///< one JavaScript module

}  // namespace lightloom::page
