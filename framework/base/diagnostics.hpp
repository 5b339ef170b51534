#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightloom {

/// A place in a text file; line and column count from 1, 0 means "no place" (a command line option, a whole file).
struct SourceLocation {
  std::string file;
  uint32_t line = 0;
  uint32_t column = 0;
  auto operator<=>(const SourceLocation&) const = default;
};

enum class Severity { note, warning, error };

/// One problem. `code` is stable and meant for tests and tools, e.g. "unknown-pass-type".
struct Diagnostic {
  std::string code;
  Severity severity = Severity::error;
  SourceLocation where;
  std::string message;  ///< one sentence, without a final full stop
  std::string hint;     ///< may be empty; "did you mean 'gather'?"
};

/// Collects every problem of a run of the graph compiler, so that a user sees all of them at once.
class Diagnostics {
 public:
  void error(std::string_view code, const SourceLocation& where, std::string message, std::string hint = {});
  void warning(std::string_view code, const SourceLocation& where, std::string message, std::string hint = {});
  [[nodiscard]] bool has_errors() const;
  /// Sorted by file, line, column; equal places keep the order in which they were reported.
  [[nodiscard]] std::vector<Diagnostic> sorted() const;
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }

 private:
  std::vector<Diagnostic> all_;
};

/// "file:line:col: error[code]: message\n  hint: …", without a final newline.
[[nodiscard]] std::string format_diagnostic(const Diagnostic& diagnostic);

}  // namespace lightloom
