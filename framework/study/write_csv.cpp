#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/study/write_results.hpp"

namespace lightloom::study {
namespace {

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
