#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom {

/// True if `pattern` matches the whole of `text`; `*` stands for any run of characters, `?` for exactly one.
[[nodiscard]] bool glob_match(std::string_view pattern, std::string_view text);

/// True if `text` holds a wildcard of glob_match.
[[nodiscard]] bool is_glob(std::string_view text);

/// The candidate with the smallest edit distance (insert, delete, replace, swap of neighbours; case is ignored) if that
/// is small enough to be a typing mistake: at most one third of the longer word, at least 1. First of equals.
[[nodiscard]] std::optional<std::string> closest_match(std::string_view word,
                                                       const std::vector<std::string>& candidates);

/// "did you mean 'x'?" for the closest candidate; otherwise, where `otherwise` is not empty, "OTHERWISE: a, b, c"
/// (at most 16 candidates); otherwise "".
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                                       std::string_view otherwise = {});

[[nodiscard]] std::string join(const std::vector<std::string>& parts, std::string_view separator);

/// Pieces between separators, empty ones included; "" gives one empty piece.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);
/// Words between blanks; 'single' and "double" quotes hold blanks together and fall away. An open quote ends with the
/// text.
[[nodiscard]] std::vector<std::string> split_words(std::string_view text);

/// 'text', with control characters escaped and long text cut, fit for a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace lightloom
