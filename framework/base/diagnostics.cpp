#include "framework/base/diagnostics.hpp"

#include <algorithm>
#include <utility>

namespace lightloom {
namespace {

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

}  // namespace

void Diagnostics::error(std::string_view code, const SourceLocation& where, std::string message, std::string hint) {
  all_.push_back({std::string(code), Severity::error, where, std::move(message), std::move(hint)});
}

void Diagnostics::warning(std::string_view code, const SourceLocation& where, std::string message, std::string hint) {
  all_.push_back({std::string(code), Severity::warning, where, std::move(message), std::move(hint)});
}

bool Diagnostics::has_errors() const {
  return std::any_of(all_.begin(), all_.end(),
                     [](const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<Diagnostic> result = all_;
  std::stable_sort(result.begin(), result.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.where < b.where; });
  return result;
}

std::string format_diagnostic(const Diagnostic& diagnostic) {
  std::string text;
  const SourceLocation& where = diagnostic.where;
  if (!where.file.empty()) {
    text += where.file;
    if (where.line > 0) text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
    text += ": ";
  }
  text += std::string(to_string(diagnostic.severity)) + "[" + diagnostic.code + "]: " + diagnostic.message;
  if (!diagnostic.hint.empty()) text += "\n  hint: " + diagnostic.hint;
  return text;
}

}  // namespace lightloom
