#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/base/json.hpp"
#include "framework/base/key_table.hpp"
#include "framework/base/limits.hpp"

namespace lightloom::scene {

/// Throws Error(invalid_input) with the sentence "FILE:LINE:COLUMN: SENTENCE".
[[noreturn]] void refuse_json(const SourceLocation& where, const std::string& sentence, std::string hint = {});

/// "FILE:LINE:COLUMN" of a value.
[[nodiscard]] std::string place_of(const JsonNode& node);

/// Reads and parses a file within json_bytes and json_values of `limits`. Throws Error(invalid_input) with the place of
/// the first mistake.
[[nodiscard]] JsonNode parse_json_file(const std::filesystem::path& path, const Limits& limits = {});

/// A number that may be left out.
struct NumberRange {
  double fallback = 0;
  double minimum = 0;
  double maximum = 0;
};

/// An object whose members are read one by one; `finish` refuses those that nobody asked for. All that is wrong is
/// thrown as Error(invalid_input) with file, line, column and the member's path ("cameras.a.eye[2]").
class JsonMembers {
 public:
  static constexpr double kLargest = 1e12;  ///< magnitude of coordinates

  /// `path` leads to the object and begins the names of its members; the object itself is called `name`.
  JsonMembers(const JsonNode& node, std::string name, std::string path);
  JsonMembers(const JsonNode& node, const std::string& path) : JsonMembers(node, path, path) {}

  /// The member, or null. Its key counts as known from now on.
  [[nodiscard]] const JsonNode* find(const std::string& key);
  [[nodiscard]] const JsonNode& require(const std::string& key);
  /// `value` again, if it is of that kind.
  const JsonNode& typed(const JsonNode& value, const std::string& key, JsonKind kind) const;
  /// A number from `min` to `max`.
  [[nodiscard]] double number(const JsonNode& value, const std::string& key, double min, double max) const;
  [[nodiscard]] double number_or(const std::string& key, double fallback, double min, double max);
  /// `count` numbers from `min` to kLargest.
  [[nodiscard]] std::vector<double> numbers(const JsonNode& value, const std::string& key, size_t count,
                                            double min) const;
  [[nodiscard]] glm::vec3 vec3(const JsonNode& value, const std::string& key, double min) const;
  [[nodiscard]] glm::vec3 vec3_or(const std::string& key, const glm::vec3& fallback, double min);
  [[nodiscard]] double number_or(const std::string& key, const NumberRange& range) {
    return number_or(key, range.fallback, range.minimum, range.maximum);
  }
  /// Refuses members that were not looked for.
  void finish() const;
  /// The same. Throws std::logic_error where what was looked for is not what the table has, from which the format's
  /// schema is made.
  void finish(KeyTable table) const;

 private:
  [[nodiscard]] std::string shown(const std::string& key) const;

  const JsonNode& node_;
  std::string name_;
  std::string path_;
  std::vector<std::string> known_;
};

}  // namespace lightloom::scene
