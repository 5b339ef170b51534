#include "framework/cli/text_layout.hpp"

#include <algorithm>

#include "framework/base/text.hpp"

namespace lightloom::cli {

size_t display_width(std::string_view text) {
  // Continuation bytes of UTF-8 are 10xxxxxx.
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

std::string wrap(std::string_view text, size_t columns, size_t indent, size_t first_column) {
  std::string result;
  size_t column = first_column;
  const auto break_line = [&] {
    result += '\n' + std::string(indent, ' ');
    column = indent;
  };
  bool first_line = true;
  for (const std::string& line : split(text, '\n')) {
    if (!first_line) break_line();
    first_line = false;
    bool first_word = true;
    for (const std::string& word : split(line, ' ')) {
      if (word.empty()) continue;
      const size_t width = display_width(word);
      if (!first_word && column + 1 + width > columns) {
        break_line();
      } else if (!first_word) {
        result += ' ';
        ++column;
      }
      result += word;
      column += width;
      first_word = false;
    }
  }
  return result;
}

std::string align_columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], display_width(row[i]));
  }
  std::string result;
  for (const auto& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
      line += row[i] + std::string(widths[i] - display_width(row[i]) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + '\n';
  }
  return result;
}

}  // namespace lightloom::cli
