#include "framework/cli/comparison_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "framework/cli/text_layout.hpp"
#include "framework/image/metric_names.hpp"

namespace lightloom::cli {
namespace {

using image::kNamedMetrics;
using image::NamedMetric;
using Row = std::vector<std::string>;

std::vector<NamedMetric> chosen(const std::vector<std::string>& names) {
  std::vector<NamedMetric> metrics;
  for (const NamedMetric& metric : kNamedMetrics)
    if (names.empty() || std::find(names.begin(), names.end(), metric.name) != names.end()) metrics.push_back(metric);
  return metrics;
}

double mean_of(const Comparison& comparison, const NamedMetric& metric) {
  double sum = 0;
  for (const ComparedFrame& frame : comparison.frames) sum += metric.value(frame.metrics);
  return sum / static_cast<double>(comparison.frames.size());
}

nlohmann::ordered_json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  if (whole) return static_cast<int64_t>(value);
  return value;
}

struct NamedFlicker {
  const char* name;
  double value;
  const char* doc;
};

std::array<NamedFlicker, 4> flicker_figures(const Comparison& comparison) {
  return {{{"flicker", comparison.flicker.deviation, "mean over pixels of the standard deviation over frames, of T"},
           {"flicker_reference", comparison.flicker_reference.deviation, "the same of R"},
           {"frame_difference", comparison.flicker.step, "mean of |luminance - that of the frame before|, of T"},
           {"frame_difference_reference", comparison.flicker_reference.step, "the same of R"}}};
}

std::string digits6(double value) {
  if (std::isnan(value)) return "-";
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string heading(const Comparison& comparison, const image::MetricOptions& options) {
  const auto decoded = [](bool removed) { return std::string(removed ? "sRGB transfer function removed" : ""); };
  const bool hdr = comparison.flip == image::FlipKind::hdr;
  const ComparedFrame &first = comparison.frames.front(), &last = comparison.frames.back();
  std::vector<Row> rows = {{"R, reference", first.reference.string(), decoded(comparison.reference_decoded)}};
  if (last.reference != first.reference) rows.push_back({"", "to " + last.reference.string(), ""});
  rows.push_back({"T, test", first.test.string(), decoded(comparison.test_decoded)});
  if (last.test != first.test) rows.push_back({"", "to " + last.test.string(), ""});
  rows.push_back({"size", to_string(comparison.extent), ""});
  rows.push_back({"FLIP", hdr ? "of radiance (HDR)" : "of display values (LDR)",
                  digits6(options.pixels_per_degree) + " pixels per degree"});
  rows.push_back({"epsilon", digits6(options.epsilon),
                  "firefly above " + digits6(options.firefly_factor) + " times the reference or epsilon"});
  return align_columns(rows);
}

std::string frame_table(const Comparison& comparison, const std::vector<NamedMetric>& metrics) {
  Row head = {"frame"}, mean = {"mean"};
  for (const NamedMetric& metric : metrics) {
    head.emplace_back(metric.name);
    mean.push_back(digits6(mean_of(comparison, metric)));
  }
  std::vector<Row> rows = {head};
  for (const ComparedFrame& frame : comparison.frames) {
    Row row = {std::to_string(frame.frame)};
    for (const NamedMetric& metric : metrics) row.push_back(digits6(metric.value(frame.metrics)));
    rows.push_back(std::move(row));
  }
  rows.push_back(std::move(mean));
  return align_columns(rows);
}

}  // namespace

nlohmann::ordered_json comparison_json(const Comparison& comparison, const std::vector<std::string>& names) {
  const std::vector<NamedMetric> metrics = chosen(names);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const NamedMetric& metric : metrics) json[metric.name] = number(mean_of(comparison, metric));
  if (!comparison.sequence) return json;
  for (const NamedFlicker& figure : flicker_figures(comparison)) json[figure.name] = number(figure.value);
  nlohmann::ordered_json& frames = json["frames"] = nlohmann::ordered_json::array();
  for (const ComparedFrame& frame : comparison.frames) {
    nlohmann::ordered_json entry = {{"frame", frame.frame}};
    for (const NamedMetric& metric : metrics) entry[metric.name] = number(metric.value(frame.metrics));
    frames.push_back(std::move(entry));
  }
  return json;
}

std::string comparison_text(const Comparison& comparison, const std::vector<std::string>& names,
                            const image::MetricOptions& options) {
  const std::vector<NamedMetric> metrics = chosen(names);
  std::string text = heading(comparison, options) + "\n";
  std::vector<Row> rows;
  if (comparison.frames.size() > 1) {
    text += frame_table(comparison, metrics) + "\n";
    for (const NamedFlicker& figure : flicker_figures(comparison))
      rows.push_back({figure.name, digits6(figure.value), figure.doc});
  } else {
    for (const NamedMetric& metric : metrics) {
      rows.push_back({std::string(metric.name), digits6(metric.value(comparison.frames.front().metrics)),
                      std::string(metric.doc)});
    }
  }
  return text + align_columns(rows);
}

}  // namespace lightloom::cli
