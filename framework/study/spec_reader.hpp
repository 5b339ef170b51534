#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/base/json.hpp"
#include "framework/base/key_table.hpp"
#include "framework/study/study_spec.hpp"

namespace lightloom::study {

/// Typed values out of a JSON tree; what has the wrong form is reported and left out.
class SpecReader {
 public:
  explicit SpecReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  bool expect(const JsonNode& node, JsonKind kind, const std::string& what);
  void check_keys(const JsonNode& object, KeyTable known, const std::string& what);
  void error(const std::string& code, const SourceLocation& where, const std::string& message,
             const std::string& hint = {});

  void read_text(const JsonNode& object, const std::string& key, std::string& value);
  void read_flag(const JsonNode& object, const std::string& key, bool& value);
  void read_count(const JsonNode& object, const std::string& key, uint32_t minimum, uint32_t maximum, uint32_t& value);
  void read_real(const JsonNode& object, const std::string& key, double minimum, double maximum, double& value);
  void read_size(const JsonNode& object, const std::string& key, std::optional<Size>& value);
  /// Whole number within both ends, or empty and reported.
  std::optional<uint32_t> count(const JsonNode& node, const std::string& what, uint32_t minimum, uint32_t maximum);
  std::optional<Size> size(const JsonNode& node, const std::string& what);
  std::vector<std::string> texts(const JsonNode& node, const std::string& what);
  /// The text that `--set` would take for the value, or empty and reported.
  std::optional<std::string> scalar(const JsonNode& node, const std::string& what);
  /// variants, set, disable, swap, size, trace_size, general; `more` are keys that the caller reads.
  Changes changes(const JsonNode& object, const std::string& what, KeyTable more = {});

 private:
  Diagnostics& diagnostics_;
};

}  // namespace lightloom::study
