#pragma once

#include <iosfwd>
#include <string_view>

#include "framework/base/diagnostics.hpp"
#include "framework/base/error.hpp"

namespace lightloom::cli {

/// "error: MESSAGE" and, on a line of its own, "  hint: HINT" unless that is empty.
void print_error(std::ostream& stream, std::string_view message, std::string_view hint);

void print_warning(std::ostream& stream, std::string_view message);

/// All problems, sorted by place, one after another.
void print_diagnostics(std::ostream& stream, const Diagnostics& diagnostics);

/// What the errors mean for the exit status: `usage` if all of them are mistakes in options (a `--set` that fits
/// nothing), `invalid_input` if the graph has any, `done` if there are none.
[[nodiscard]] ExitCode exit_code_of(const Diagnostics& diagnostics);

}  // namespace lightloom::cli
