#include "framework/study/write_results.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/atomic_file.hpp"
#include "framework/study/report.hpp"

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

}  // namespace

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
  if (times == Times::with) write_file_atomically(folder / "report.html", make_report(results, folder));
}

}  // namespace lightloom::study
