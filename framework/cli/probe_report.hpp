#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "framework/run/probe.hpp"

namespace lightloom::cli {

/// Text for people: each pass in order, with a line for each value, and one more for what its pass says of it where
/// `explain` is set.
void print_probe(std::ostream& out, const run::ProbeReport& report, uint32_t x, uint32_t y, bool explain = false);

/// The same for programs. Numbers are exact; those that JSON has no way to write are the strings "NaN", "Infinity" and
/// "-Infinity".
[[nodiscard]] nlohmann::ordered_json probe_json(const run::ProbeReport& report, uint32_t x, uint32_t y);

}  // namespace lightloom::cli
