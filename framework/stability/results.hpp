#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "framework/gpu/device.hpp"
#include "framework/stability/run_checks.hpp"

namespace lightloom::stability {

/// Where and by what a table was made.
struct TableOrigin {
  const gpu::DeviceInfo& device;
  bool validation = false;  ///< whether the validation layers watched
  std::string version;      ///< of the program
};

/// Four significant digits: "0.0001234", "1.2e-09", "12340", "nan".
[[nodiscard]] std::string number_text(double value);

/// "value <= threshold unit", with "MISSED" behind where it does not hold.
[[nodiscard]] std::string figure_text(const Figure& figure);

/// {device, driver, validation, lightloom, checks: [{name, group, extreme, danger, guard, passed, seconds, failure,
/// figures: [{what, value, relation, threshold, unit, holds}]}]}. A value that is no number is null.
[[nodiscard]] nlohmann::ordered_json to_json(std::span<const Outcome> outcomes, const TableOrigin& origin);

/// "27 of 28 checks passed, 130 of 131 figures hold."
[[nodiscard]] std::string summary_text(std::span<const Outcome> outcomes);

/// The same as a document: a summary, a table a group, and what each check guards against.
[[nodiscard]] std::string to_markdown(std::span<const Outcome> outcomes, const TableOrigin& origin);

/// The same as an HTML page that needs nothing outside itself.
[[nodiscard]] std::string to_html(std::span<const Outcome> outcomes, const TableOrigin& origin);

}  // namespace lightloom::stability
