#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace lightloom::page {

/// Each {{name}} of a page replaced once by what `places` has for it; what is put in is not looked at again. Throws
/// std::out_of_range for a name that `places` lacks.
[[nodiscard]] std::string fill(std::string_view page, const std::map<std::string, std::string, std::less<>>& places);

/// Text as HTML shows it, fit for content and quoted attributes.
[[nodiscard]] std::string escape_html(std::string_view text);

/// JSON that may stand in a <script> element, whatever its strings hold.
[[nodiscard]] std::string escape_for_script(std::string_view json);

}  // namespace lightloom::page
