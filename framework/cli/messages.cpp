#include "framework/cli/messages.hpp"

#include <algorithm>
#include <array>
#include <ostream>

namespace lightloom::cli {
namespace {

/// An option's own mistakes. Others that are reported at an option (a pass without a bypass that --disable names) make
/// the graph invalid.
constexpr std::array<std::string_view, 8> kUsageCodes = {"no-match",      "unknown-variant",   "unknown-graph-param",
                                                         "unknown-param", "unknown-pass-type", "unknown-choice",
                                                         "wrong-type",    "out-of-range"};

bool is_usage(const Diagnostic& diagnostic) {
  return diagnostic.where.file.starts_with("--") &&
         std::find(kUsageCodes.begin(), kUsageCodes.end(), diagnostic.code) != kUsageCodes.end();
}

}  // namespace

void print_error(std::ostream& stream, std::string_view message, std::string_view hint) {
  stream << "error: " << message << '\n';
  if (!hint.empty()) stream << "  hint: " << hint << '\n';
}

void print_warning(std::ostream& stream, std::string_view message) {
  stream << "warning: " << message << '\n';
}

void print_diagnostics(std::ostream& stream, const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.sorted()) stream << format_diagnostic(diagnostic) << '\n';
}

ExitCode exit_code_of(const Diagnostics& diagnostics) {
  ExitCode code = ExitCode::done;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.severity != Severity::error) continue;
    if (!is_usage(diagnostic)) return ExitCode::invalid_input;
    code = ExitCode::usage;
  }
  return code;
}

}  // namespace lightloom::cli
