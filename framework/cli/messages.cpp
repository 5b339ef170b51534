#include "framework/cli/messages.hpp"

#include <ostream>

namespace lightloom::cli {

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
    if (!diagnostic.where.file.starts_with("--")) return ExitCode::invalid_input;
    code = ExitCode::usage;
  }
  return code;
}

}  // namespace lightloom::cli
