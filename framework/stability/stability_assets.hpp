#pragma once

#include <string_view>

namespace lightloom::stability {

/// The parts of the page that are the same for all tables, embedded at build from framework/stability/page and
/// framework/page/shared.
[[nodiscard]] std::string_view stability_page();    ///< HTML with places {{name}} that to_html fills
[[nodiscard]] std::string_view stability_style();   ///< CSS
[[nodiscard]] std::string_view stability_script();  ///< one JavaScript module

}  // namespace lightloom::stability
