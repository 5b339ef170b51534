#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom::cli {

/// Characters of a UTF-8 text, each taken as one column wide.
[[nodiscard]] size_t display_width(std::string_view text);

/// Breaks lines at blanks so that none is wider than `columns` (a single longer word stands alone). Lines after the
/// first begin with `indent` blanks; the first is taken to begin at column `first_column`. Line breaks in `text` stay.
[[nodiscard]] std::string wrap(std::string_view text, size_t columns, size_t indent, size_t first_column = 0);

/// Rows of equal length as columns that are two blanks apart; no blanks at the ends of lines; with a final newline.
[[nodiscard]] std::string align_columns(const std::vector<std::vector<std::string>>& rows);

}  // namespace lightloom::cli
