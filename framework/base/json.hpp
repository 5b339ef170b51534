#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/diagnostics.hpp"

namespace lightloom {

enum class JsonKind : uint8_t { null, boolean, integer, real, string, array, object };

struct JsonMember;

/// One JSON value with the place of its first character. Numbers without fraction and exponent that fit are `integer`,
/// all others `real`.
struct JsonNode {
  JsonKind kind = JsonKind::null;
  SourceLocation where;
  bool boolean = false;
  int64_t integer = 0;
  double real = 0;  ///< also set for integers
  std::string string;
  std::vector<JsonNode> elements;   ///< array
  std::vector<JsonMember> members;  ///< object, in file order, keys unique

  /// Member of an object; null if absent or not an object.
  [[nodiscard]] const JsonNode* find(std::string_view key) const;
};

struct JsonMember {
  std::string key;
  SourceLocation where;  ///< of the key's opening quote
  JsonNode value;
};

[[nodiscard]] std::string_view to_string(JsonKind kind);  ///< "an object", "a string", … for messages

constexpr std::size_t kJsonMaximumDepth = 64;
constexpr uint64_t kJsonMaximumValues = 1'000'000;  ///< a node takes some 200 bytes

/// RFC 8259 text to a tree. Columns count characters (code points) from 1; a line ends with LF, CRLF or CR; a leading
/// UTF-8 byte order mark counts for nothing. Problems go to `diagnostics`: `json-syntax` (one, at the offending token),
/// `json-depth` (nested deeper than kJsonMaximumDepth) and `json-size` (more values than `most_values`) give an empty
/// result; `duplicate-key` (at each second key) keeps the first, so that the caller can look for further problems.
/// Never throws.
[[nodiscard]] std::optional<JsonNode> parse_json(std::string_view text, const std::string& file_name,
                                                 Diagnostics& diagnostics, uint64_t most_values = kJsonMaximumValues);

}  // namespace lightloom
