#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom {

/// A key that an object of a JSON format may have, and what it means. The reader of the format and its JSON Schema
/// go by the same tables.
struct KeyDoc {
  std::string_view key;
  std::string_view doc;
};
using KeyTable = std::span<const KeyDoc>;

[[nodiscard]] inline std::vector<std::string> keys_of(KeyTable table) {
  std::vector<std::string> keys;
  for (const KeyDoc& row : table) keys.emplace_back(row.key);
  return keys;
}

}  // namespace lightloom
