#include "framework/study/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "framework/base/base64.hpp"
#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/page/page.hpp"
#include "framework/study/graph_layout.hpp"
#include "framework/study/metric_info.hpp"

namespace lightloom::study {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

Json estimate(const Estimate& e) {
  return {{"mean", number(e.mean)},
          {"low", number(e.low)},
          {"high", number(e.high)},
          {"deviation", number(e.standard_deviation)},
          {"count", e.count}};
}

Json timing(const Timing& t) {
  return {{"median", number(t.median)}, {"p95", number(t.p95)}};
}

Json pairs(const std::vector<std::pair<std::string, std::string>>& values) {
  Json list = Json::array();
  for (const auto& [name, value] : values) list.push_back({name, value});
  return list;
}

/// Files named by index, each content once.
class Pictures {
 public:
  explicit Pictures(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Json index(const std::filesystem::path& file) {
    if (file.empty()) return nullptr;
    if (const auto known = by_file_.find(file.generic_string()); known != by_file_.end()) return known->second;
    const auto [entry, made] = by_content_.emplace(read(folder_ / file), by_content_.size());
    if (made) encoded_.push_back(encode_base64(entry->first));
    const size_t index = entry->second;
    by_file_.emplace(file.generic_string(), index);
    return index;
  }
  [[nodiscard]] Json all() const { return encoded_; }

 private:
  static std::string read(const std::filesystem::path& file) {
    try {
      return read_text_file(file);
    } catch (const Error& error) {
      throw Error(ExitCode::run_failed, std::string("the report needs a picture of the study: ") + error.what(),
                  "run the study again with --fresh");
    }
  }

  std::filesystem::path folder_;
  std::map<std::string, size_t> by_file_;
  std::map<std::string, size_t> by_content_;
  Json encoded_ = Json::array();
};

Json row_metrics(const Row& row) {
  Json metrics = Json::object();
  for (const auto& [name, value] : row.metrics) metrics[name] = estimate(value);
  if (row.bias_squared.count > 0) metrics["bias_squared"] = estimate(row.bias_squared);
  if (row.variance.count > 0) metrics["variance"] = estimate(row.variance);
  return metrics;
}

Json row_passes(const Row& row) {
  Json passes = Json::array();
  for (const auto& pass : row.passes) {
    passes.push_back(
        {{"pass", pass.pass}, {"frame", timing(pass.frame)}, {"once", number(pass.once)}, {"hoisted", pass.hoisted}});
  }
  return passes;
}

Json row_json(const Row& row, Pictures& pictures) {
  Json verdicts = Json::object();
  for (const auto& [name, verdict] : row.verdicts) {
    verdicts[name] = {{"difference", estimate(verdict.difference)},
                      {"ratio", number(verdict.ratio)},
                      {"within_noise", verdict.within_noise}};
  }
  return {{"setting", row.setting},
          {"scene", row.scene},
          {"camera", row.camera},
          {"values", pairs(row.values)},
          {"command", row.command},
          {"culled", row.culled},
          {"disabled", row.disabled},
          {"error", row.error},
          {"metrics", row_metrics(row)},
          {"verdicts", verdicts},
          {"frame_ms", estimate(row.frame_ms)},
          {"frame", timing(row.frame)},
          {"wall", timing(row.wall)},
          {"disturbed", row.disturbed},
          {"once_ms", number(row.once_ms)},
          {"first_frame_ms", number(row.first_frame_ms)},
          {"passes", row_passes(row)},
          {"memory_bytes", row.memory_bytes},
          {"pareto", row.pareto},
          {"picture", pictures.index(row.picture)},
          {"heat_map", pictures.index(row.heat_map)}};
}

/// The views that the study names, then those that only rows name.
Json views_json(const StudyResults& results, Pictures& pictures) {
  Json views = Json::array();
  std::set<std::pair<std::string, std::string>> known;
  for (const auto& view : results.views) {
    if (!known.emplace(view.scene, view.camera).second) continue;
    views.push_back({{"scene", view.scene},
                     {"camera", view.camera},
                     {"reference", pictures.index(view.reference)},
                     {"relmse", number(view.reference_relmse)},
                     {"note", view.reference_note}});
  }
  for (const auto& row : results.rows) {
    if (!known.emplace(row.scene, row.camera).second) continue;
    views.push_back(
        {{"scene", row.scene}, {"camera", row.camera}, {"reference", nullptr}, {"relmse", 0}, {"note", ""}});
  }
  return views;
}

Json metrics_json(const StudyResults& results) {
  std::vector<std::string> names{results.metric};
  for (const auto& row : results.rows) {
    const Json metrics = row_metrics(row);
    for (const auto& [name, value] : metrics.items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  std::stable_sort(names.begin() + 1, names.end(),
                   [](const auto& a, const auto& b) { return metric_rank(a) < metric_rank(b); });
  Json list = Json::array();
  for (const auto& name : names) {
    if (name.empty()) continue;
    const MetricInfo info = metric_info(name);
    const char* best = info.nearest_zero_is_best ? "zero" : info.higher_is_better ? "high" : "low";
    list.push_back(
        {{"name", info.name}, {"label", info.label}, {"unit", info.unit}, {"best", best}, {"doc", info.doc}});
  }
  return list;
}

Json trades_json(const std::vector<TradeEntry>& entries) {
  Json list = Json::array();
  for (const auto& entry : entries) {
    list.push_back({{"scene", entry.scene},
                    {"camera", entry.camera},
                    {"setting", entry.setting},
                    {"target", number(entry.target)},
                    {"milliseconds", number(entry.milliseconds)},
                    {"error", number(entry.error)},
                    {"note", entry.note}});
  }
  return list;
}

Json graph_json(const StudyResults& results) {
  const GraphLayout layout = lay_out(results.graph_passes, results.graph_edges);
  Json passes = Json::array();
  for (size_t i = 0; i < layout.boxes.size(); ++i) {
    const auto& pass = results.graph_passes[i];
    const auto& box = layout.boxes[i];
    passes.push_back({{"name", pass.name},
                      {"type", pass.type},
                      {"hoisted", pass.hoisted},
                      {"layer", box.layer},
                      {"x", std::round(box.x)},
                      {"y", box.y},
                      {"width", box.width},
                      {"height", box.height}});
  }
  Json edges = Json::array();
  for (const auto& edge : layout.edges) {
    edges.push_back({{"from", edge.from},
                     {"to", edge.to},
                     {"history", edge.history},
                     {"ages", edge.ages},
                     {"labels", edge.labels},
                     {"path", edge.path},
                     {"x", std::round(edge.label_x)},
                     {"y", std::round(edge.label_y)}});
  }
  return {
      {"width", std::ceil(layout.width)}, {"height", std::ceil(layout.height)}, {"passes", passes}, {"edges", edges}};
}

}  // namespace

std::string report_data(const StudyResults& results, const std::filesystem::path& folder) {
  Pictures pictures(folder);
  Json data = {{"name", results.name},
               {"graph", results.graph},
               {"metric", results.metric},
               {"axes", results.axes},
               {"metrics", metrics_json(results)},
               {"views", views_json(results, pictures)},
               {"rows", Json::array()},
               {"equal_time", trades_json(results.equal_time)},
               {"equal_error", trades_json(results.equal_error)},
               {"drawing", graph_json(results)}};
  for (const auto& row : results.rows) data["rows"].push_back(row_json(row, pictures));
  data["pictures"] = pictures.all();
  return page::escape_for_script(data.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace lightloom::study
