#include "framework/study/write_results.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/base/atomic_file.hpp"
#include "framework/base/text.hpp"

namespace lightloom::study {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Estimate& estimate) {
  return {{"mean", estimate.mean},
          {"low", estimate.low},
          {"high", estimate.high},
          {"standard_deviation", estimate.standard_deviation},
          {"count", estimate.count}};
}

Json to_json(const Timing& timing) {
  return {{"median_ms", timing.median}, {"p95_ms", timing.p95}};
}

Json to_json(const std::vector<std::pair<std::string, std::string>>& pairs) {
  Json object = Json::object();
  for (const auto& [name, value] : pairs) object[name] = value;
  return object;
}

Json verdicts_json(const Row& row, Times times) {
  Json object = Json::object();
  for (const auto& [name, verdict] : row.verdicts)
    if (name != "frame_ms" || times == Times::with)
      object[name] = {{"difference", to_json(verdict.difference)},
                      {"ratio", verdict.ratio},
                      {"within_noise", verdict.within_noise}};
  return object;
}

void add_times(Json& json, const Row& row) {
  json["frame_ms"] = to_json(row.frame_ms);
  json["frame"] = to_json(row.frame);
  json["wall"] = to_json(row.wall);
  json["once_ms"] = row.once_ms;
  json["first_frame_ms"] = row.first_frame_ms;
  json["disturbed"] = row.disturbed;
  json["pareto"] = row.pareto;
  Json passes = Json::array();
  for (const PassTiming& pass : row.passes)
    passes.push_back(pass.hoisted ? Json{{"pass", pass.pass}, {"hoisted", true}, {"once_ms", pass.once}}
                                  : Json{{"pass", pass.pass},
                                         {"hoisted", false},
                                         {"median_ms", pass.frame.median},
                                         {"p95_ms", pass.frame.p95}});
  json["passes"] = passes;
}

Json to_json(const Row& row, Times times) {
  Json json = {{"setting", row.setting},        {"scene", row.scene},  {"camera", row.camera},
               {"values", to_json(row.values)}, {"error", row.error},  {"command", row.command},
               {"disabled", row.disabled},      {"culled", row.culled}};
  if (!row.error.empty()) return json;
  for (const auto& [name, estimate] : row.metrics) json["metrics"][name] = to_json(estimate);
  json["bias_squared"] = to_json(row.bias_squared);
  json["variance"] = to_json(row.variance);
  json["verdicts"] = verdicts_json(row, times);
  json["memory_bytes"] = row.memory_bytes;
  json["picture"] = row.picture.generic_string();
  json["heat_map"] = row.heat_map.generic_string();
  if (times == Times::with) add_times(json, row);
  return json;
}

Json to_json(const std::vector<TradeEntry>& table) {
  Json list = Json::array();
  for (const TradeEntry& entry : table)
    list.push_back({{"scene", entry.scene},
                    {"camera", entry.camera},
                    {"setting", entry.setting},
                    {"target", entry.target},
                    {"milliseconds", entry.milliseconds},
                    {"error", entry.error},
                    {"note", entry.note}});
  return list;
}

Json views_json(const StudyResults& results) {
  Json list = Json::array();
  for (const View& view : results.views)
    list.push_back({{"scene", view.scene},
                    {"camera", view.camera},
                    {"reference", view.reference.generic_string()},
                    {"reference_relmse", view.reference_relmse},
                    {"reference_note", view.reference_note}});
  return list;
}

std::vector<std::string> notes_of(const StudyResults& results, Times times) {
  std::vector<std::string> notes = results.notes;
  if (times == Times::without) std::erase(notes, kDisturbedNote);
  return notes;
}

Json graph_json(const StudyResults& results) {
  Json graph = {{"passes", Json::array()}, {"edges", Json::array()}};
  for (const auto& pass : results.graph_passes)
    graph["passes"].push_back({{"name", pass.name}, {"type", pass.type}, {"hoisted", pass.hoisted}});
  for (const auto& edge : results.graph_edges)
    graph["edges"].push_back({{"from", edge.from}, {"to", edge.to}, {"label", edge.label}, {"age", edge.age}});
  return graph;
}

/// Lines of cells, quoted where they must be.
class CsvWriter {
 public:
  void text(const std::string& value) {
    const bool quoted = value.find_first_of(",\"\r\n") != std::string::npos;
    std::string cell;
    for (const char c : value) cell += c == '"' ? "\"\"" : std::string(1, c);
    add(quoted ? '"' + cell + '"' : cell);
  }
  void number(double value) {
    char digits[32];
    const auto result = std::to_chars(digits, digits + sizeof(digits), value);
    add(std::string(digits, result.ptr));
  }
  void empty(size_t count) {
    for (size_t i = 0; i < count; ++i) add({});
  }
  void end_line() {
    text_ += "\r\n";
    first_ = true;
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void add(const std::string& cell) {
    text_ += (first_ ? "" : ",") + cell;
    first_ = false;
  }
  std::string text_;
  bool first_ = true;
};

std::vector<std::string> metrics_of(const StudyResults& results) {
  std::set<std::string> names;
  for (const Row& row : results.rows)
    for (const auto& [name, estimate] : row.metrics) names.insert(name);
  std::vector<std::string> list;
  if (names.erase(results.metric) > 0) list.push_back(results.metric);
  list.insert(list.end(), names.begin(), names.end());
  return list;
}

constexpr const char* kTimeColumns[] = {"frame_ms",       "frame_ms_low",   "frame_ms_high", "frame_median_ms",
                                        "frame_p95_ms",   "wall_median_ms", "wall_p95_ms",   "once_ms",
                                        "first_frame_ms", "disturbed",      "pareto"};

void head(CsvWriter& csv, const StudyResults& results, const std::vector<std::string>& metrics, Times times) {
  for (const char* column : {"scene", "camera", "setting"}) csv.text(column);
  for (const std::string& axis : results.axes) csv.text(axis);
  for (const char* column : {"error", "seeds"}) csv.text(column);
  for (const std::string& metric : metrics)
    for (const char* suffix :
         {"", "_low", "_high", "_sd", "_difference", "_difference_low", "_difference_high", "_within_noise"})
      csv.text(metric + suffix);
  for (const char* column : {"bias_squared", "bias_squared_low", "bias_squared_high", "variance", "variance_low",
                             "variance_high", "memory_bytes"})
    csv.text(column);
  if (times == Times::with)
    for (const char* column : kTimeColumns) csv.text(column);
  for (const char* column : {"disabled", "culled", "picture", "heat_map", "command"}) csv.text(column);
  csv.end_line();
}

void interval(CsvWriter& csv, const Estimate& estimate) {
  if (estimate.count == 0) return csv.empty(3);
  csv.number(estimate.mean);
  if (estimate.low == estimate.mean && estimate.high == estimate.mean && estimate.count < 3) return csv.empty(2);
  csv.number(estimate.low);
  csv.number(estimate.high);
}

void metric_cells(CsvWriter& csv, const Row& row, const std::string& metric) {
  const Estimate& estimate = row.metrics.at(metric);
  csv.number(estimate.mean);
  if (estimate.count > 1) {
    for (const double value : {estimate.low, estimate.high, estimate.standard_deviation}) csv.number(value);
  } else {
    csv.empty(3);
  }
  const auto verdict = row.verdicts.find(metric);
  if (verdict == row.verdicts.end()) return csv.empty(4);
  csv.number(verdict->second.difference.mean);
  if (verdict->second.difference.count > 1) {
    csv.number(verdict->second.difference.low);
    csv.number(verdict->second.difference.high);
  } else {
    csv.empty(2);
  }
  csv.text(verdict->second.within_noise ? "true" : "false");
}

void time_cells(CsvWriter& csv, const Row& row) {
  csv.number(row.frame_ms.mean);
  if (row.frame_ms.count > 1) {
    csv.number(row.frame_ms.low);
    csv.number(row.frame_ms.high);
  } else {
    csv.empty(2);
  }
  for (const double value :
       {row.frame.median, row.frame.p95, row.wall.median, row.wall.p95, row.once_ms, row.first_frame_ms})
    csv.number(value);
  csv.text(row.disturbed ? "true" : "false");
  csv.text(row.pareto ? "true" : "false");
}

void row_line(CsvWriter& csv, const StudyResults& results, const Row& row, const std::vector<std::string>& metrics,
              Times times) {
  for (const std::string& text : {row.scene, row.camera, row.setting}) csv.text(text);
  for (const std::string& axis : results.axes) {
    const auto value =
        std::find_if(row.values.begin(), row.values.end(), [&](const auto& entry) { return entry.first == axis; });
    csv.text(value == row.values.end() ? std::string() : value->second);
  }
  csv.text(row.error);
  if (row.error.empty()) {
    csv.number(row.metrics.empty() ? 0 : row.metrics.begin()->second.count);
    for (const std::string& metric : metrics) metric_cells(csv, row, metric);
    interval(csv, row.bias_squared);
    interval(csv, row.variance);
    csv.number(static_cast<double>(row.memory_bytes));
    if (times == Times::with) time_cells(csv, row);
  } else {
    csv.empty(1 + 8 * metrics.size() + 7 + (times == Times::with ? std::size(kTimeColumns) : 0));
  }
  csv.text(join(row.disabled, " "));
  csv.text(join(row.culled, " "));
  csv.text(row.picture.generic_string());
  csv.text(row.heat_map.generic_string());
  csv.text(shell_text(row.command));
  csv.end_line();
}

}  // namespace

std::string results_csv(const StudyResults& results, Times times) {
  CsvWriter csv;
  const std::vector<std::string> metrics = metrics_of(results);
  head(csv, results, metrics, times);
  for (const Row& row : results.rows) row_line(csv, results, row, metrics, times);
  return csv.take();
}

std::string cells_csv(const StudyResults& results, const std::vector<CellResult>& cells, Times times) {
  CsvWriter csv;
  for (const char* column : {"scene", "camera", "setting", "seed"}) csv.text(column);
  const std::vector<std::string> metrics = metrics_of(results);
  for (const std::string& metric : metrics) csv.text(metric);
  if (times == Times::with)
    for (const char* column : {"frame_ms", "wall_ms"}) csv.text(column);
  csv.text("cell");
  csv.end_line();
  for (const CellResult& cell : cells) {
    const Row& row = results.rows[cell.row];
    for (const std::string& text : {row.scene, row.camera, row.setting}) csv.text(text);
    csv.number(cell.seed);
    for (const std::string& metric : metrics) csv.number(cell.metrics.at(metric));
    if (times == Times::with)
      for (const double value : {cell.frame_ms, cell.wall_ms}) csv.number(value);
    csv.text("cells/" + cell.key);
    csv.end_line();
  }
  return csv.take();
}

std::string results_json(const StudyResults& results, Times times) {
  Json json = {{"lightloom_results", 1},
               {"name", results.name},
               {"description", results.description},
               {"graph", results.graph},
               {"metric", results.metric},
               {"axes", results.axes},
               {"provenance", to_json(results.provenance)},
               {"notes", notes_of(results, times)},
               {"views", views_json(results)}};
  json["rows"] = Json::array();
  for (const Row& row : results.rows) json["rows"].push_back(to_json(row, times));
  if (times == Times::with) {
    json["equal_time"] = to_json(results.equal_time);
    json["equal_error"] = to_json(results.equal_error);
  }
  json["graph_drawn"] = graph_json(results);
  return json.dump(1) + "\n";
}

void write_results(const StudyResults& results, const std::vector<CellResult>& cells,
                   const std::filesystem::path& folder, Times times) {
  write_file_atomically(folder / "results.csv", results_csv(results, times));
  write_file_atomically(folder / "cells.csv", cells_csv(results, cells, times));
  write_file_atomically(folder / "results.json", results_json(results, times));
}

std::string shell_text(const std::vector<std::string>& words) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=,:@%+";
  std::vector<std::string> quoted;
  for (const std::string& word : words) {
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      quoted.push_back(word);
      continue;
    }
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
    quoted.push_back(text + "'");
  }
  return join(quoted, " ");
}

}  // namespace lightloom::study
