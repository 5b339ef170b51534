#include "framework/stability/results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace lightloom::stability {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json to_json(const Figure& figure) {
  return {{"what", figure.what},
          {"value", number(figure.value)},
          {"relation", to_string(figure.relation)},
          {"threshold", number(figure.threshold)},
          {"unit", figure.unit},
          {"holds", holds(figure)}};
}

Json to_json(const Outcome& outcome) {
  Json figures = Json::array();
  for (const Figure& figure : outcome.figures) figures.push_back(to_json(figure));
  return {{"name", outcome.check->name},        {"group", outcome.check->group}, {"extreme", outcome.check->extreme},
          {"danger", outcome.check->danger},    {"guard", outcome.check->guard}, {"passed", passed(outcome)},
          {"seconds", number(outcome.seconds)}, {"failure", outcome.failure},    {"figures", figures}};
}

/// Text that may stand in a cell of a table.
std::string cell(std::string text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return escaped;
}

std::string verdict(bool good) {
  return good ? "yes" : "**no**";
}

std::string rows_of(const Outcome& outcome) {
  std::string rows;
  std::string name = "`" + outcome.check->name + "`";
  for (const Figure& figure : outcome.figures) {
    rows += "| " + name + " | " + cell(figure.what) + " | " + number_text(figure.value) + " | " +
            to_string(figure.relation) + " " + number_text(figure.threshold) + " | " + cell(figure.unit) + " | " +
            verdict(holds(figure)) + " |\n";
    name.clear();
  }
  if (!outcome.failure.empty()) rows += "| " + name + " | " + cell(outcome.failure) + " | | | | **no** |\n";
  return rows;
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  std::array<char, 32> text{};
  // Counts and powers of ten are shown whole, so that thresholds read as they are written.
  const bool whole = value == std::floor(value) && std::abs(value) < 1e7;
  std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.4g", value);
  return text.data();
}

std::string figure_text(const Figure& figure) {
  return number_text(figure.value) + " " + to_string(figure.relation) + " " + number_text(figure.threshold) +
         (figure.unit.empty() ? "" : " " + figure.unit) + (holds(figure) ? "" : "  MISSED");
}

std::string summary_text(std::span<const Outcome> outcomes) {
  const auto good = std::count_if(outcomes.begin(), outcomes.end(), passed);
  size_t figures = 0, holding = 0;
  for (const Outcome& outcome : outcomes) {
    figures += outcome.figures.size();
    holding += static_cast<size_t>(std::count_if(outcome.figures.begin(), outcome.figures.end(), holds));
  }
  return std::to_string(good) + " of " + std::to_string(outcomes.size()) + " checks passed, " +
         std::to_string(holding) + " of " + std::to_string(figures) + " figures hold.";
}

Json to_json(std::span<const Outcome> outcomes, const TableOrigin& origin) {
  Json checks = Json::array();
  for (const Outcome& outcome : outcomes) checks.push_back(to_json(outcome));
  return {{"device", origin.device.name},
          {"driver", origin.device.driver + " " + origin.device.driver_info},
          {"validation", origin.validation},
          {"lightloom", origin.version},
          {"passed", std::all_of(outcomes.begin(), outcomes.end(), passed)},
          {"checks", checks}};
}

std::string to_markdown(std::span<const Outcome> outcomes, const TableOrigin& origin) {
  const gpu::DeviceInfo& device = origin.device;
  std::string text = summary_text(outcomes) + "\n\nDevice: " + device.name + ", " + device.driver + " " +
                     device.driver_info + "; validation layers " + (origin.validation ? "on" : "off") + "; " +
                     origin.version + ".\n";
  std::string group;
  for (const Outcome& outcome : outcomes) {
    if (outcome.check->group != group) {
      group = outcome.check->group;
      text += "\n## " + group + "\n\n| check | figure | value | bound | unit | holds |\n";
      text += "| --- | --- | --- | --- | --- | --- |\n";
    }
    text += rows_of(outcome);
  }
  text += "\n## What they guard against\n\n| check | extreme | without a guard | guard |\n| --- | --- | --- | --- |\n";
  for (const Outcome& outcome : outcomes) {
    const Check& check = *outcome.check;
    text += "| `" + check.name + "` | " + cell(check.extreme) + " | " + cell(check.danger) + " | " + cell(check.guard) +
            " |\n";
  }
  return text;
}

}  // namespace lightloom::stability
