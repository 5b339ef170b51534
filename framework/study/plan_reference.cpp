#include "framework/study/plan_reference.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"
#include "framework/base/text.hpp"
#include "framework/run/compute_types.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/study/fingerprint.hpp"
#include "framework/study/linked_graph.hpp"
#include "framework/study/render_cell.hpp"

namespace lightloom::study {
namespace {

/// So many seeds of the baseline make up for a reference that nobody gave.
constexpr uint32_t kBaselineFrames = 16;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string value_text(const ParamValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : to_string(value);
}

/// What light is, rather than how well it is computed. A reference of another model would count the difference as
/// error.
constexpr std::array<const char*, 2> kModelParams = {"bounces", "ward"};

/// A param of the graph, or of the one pass that has it.
std::optional<std::string> model_param(const Graph& graph, const std::string& name) {
  for (const auto& [param, value] : graph.params)
    if (param == name) return value_text(value);
  std::optional<std::string> found;
  for (const GraphPass& pass : graph.passes) {
    const ParamSet::Entry* entry = pass.params.find(name);
    if (entry == nullptr) continue;
    if (found) return std::nullopt;
    found = value_text(entry->value);
  }
  return found;
}

/// A param as the row's graph has it: "bounces" of the graph, or "trace.bounces" of a pass.
std::optional<std::string> param_of(const Graph& graph, const std::string& name) {
  for (const auto& [param, value] : graph.params)
    if (param == name) return value_text(value);
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  for (const GraphPass& pass : graph.passes)
    if (pass.name == name.substr(0, dot))
      if (const ParamSet::Entry* entry = pass.params.find(name.substr(dot + 1))) return value_text(entry->value);
  return std::nullopt;
}

std::string describe(const Graph& graph, const ReferenceSpec& reference, const std::string& what) {
  std::vector<std::string> params;
  for (const auto& [name, value] : graph.params) params.push_back(name + "=" + value_text(value));
  std::string text = what;
  if (!params.empty()) text += " with " + join(params, ", ");
  if (reference.frames > 1)
    text += (reference.average ? ", mean of " : ", after ") + std::to_string(reference.frames) + " frames";
  return text + ", seed " + std::to_string(reference.seed);
}

}  // namespace

void ReferencePlanner::run() {
  const ReferenceSpec& spec = plan_.spec.reference;
  std::optional<GraphSpec> other;
  if (spec.kind == ReferenceSpec::Kind::graph) {
    other = run::read_graph(spec.graph, registry_, plan_.shaders, diagnostics_);
    if (!other || diagnostics_.has_errors()) return;
    for (const char* name : kModelParams)
      if (std::any_of(other->params.begin(), other->params.end(),
                      [&](const auto& param) { return param.name == name; }))
        model_params_.emplace_back(name);
  }
  for (PlannedRow& row : plan_.rows) {
    if (!row.plan) continue;
    if (spec.kind == ReferenceSpec::Kind::image) {
      add(row, image(row));
      continue;
    }
    const std::string what = spec.kind == ReferenceSpec::Kind::graph ? "graph '" + other->name + "'"
                             : spec.kind == ReferenceSpec::Kind::setting
                                 ? "graph '" + graph_.name + "' with other settings"
                                 : "the baseline itself, no other was given";
    std::optional<PlannedReference> reference = rendered(row, other ? *other : graph_, what);
    if (!reference) return;
    add(row, std::move(*reference));
  }
}

PlannedReference ReferencePlanner::image(const PlannedRow& row) const {
  const PlannedView& view = plan_.views[row.view];
  const Graph& graph = row.plan->graph;
  PlannedReference reference;
  reference.view = row.view;
  reference.kind = ReferenceSpec::Kind::image;
  for (const uint32_t frame : plan_.judged_frames) {
    std::string file = plan_.spec.reference.image;
    replace_all(file, "{scene}", plan_.scenes[view.scene]->name);
    replace_all(file, "{camera}", view.camera);
    replace_all(file, "{size}", size_text({graph.view.width, graph.view.height}));
    replace_all(file, "{frame}", run::frame_text(frame));
    reference.images.emplace_back(file);
  }
  reference.note = reference.images.back().filename().string();
  Hasher hasher;
  hasher.text(plan_.scenes[view.scene]->name + " " + view.camera);
  for (const std::filesystem::path& file : reference.images) hasher.number(hash_text(read_text_file(file)));
  reference.key = hex(hasher.value());
  return reference;
}

std::optional<std::string> ReferencePlanner::shared_by_rows(const std::string& param) const {
  std::optional<std::string> shared;
  for (const PlannedRow& row : plan_.rows) {
    if (!row.plan) continue;
    const std::optional<std::string> value = model_param(row.plan->graph, param);
    if (!value || (shared && *shared != *value)) return std::nullopt;
    shared = value;
  }
  return shared;
}

Changes ReferencePlanner::changes_for(const PlannedRow& row) const {
  const ReferenceSpec& spec = plan_.spec.reference;
  const Graph& graph = row.plan->graph;
  Changes changes;
  if (spec.kind != ReferenceSpec::Kind::graph) changes = plan_.spec.changes;
  if (spec.kind == ReferenceSpec::Kind::baseline) changes = combine(changes, plan_.settings.list.front().changes);
  changes = combine(changes, spec.changes);
  for (const std::string& name : spec.match)
    if (auto value = param_of(graph, name)) changes.sets.emplace_back(name, *value);
  for (const std::string& name : model_params_) {
    const bool said =
        std::any_of(changes.sets.begin(), changes.sets.end(), [&](const auto& set) { return set.first == name; });
    const auto value = said ? std::nullopt : shared_by_rows(name);
    if (value) changes.sets.emplace_back(name, *value);
  }
  changes.size = Size{graph.view.width, graph.view.height};
  // Light is traced at full size for a reference, unless it says otherwise.
  if (spec.kind != ReferenceSpec::Kind::baseline)
    changes.trace_size = spec.changes.trace_size ? spec.changes.trace_size : changes.size;
  return changes;
}

std::optional<PlannedReference> ReferencePlanner::rendered(const PlannedRow& row, const GraphSpec& graph,
                                                           const std::string& what) {
  ReferenceSpec spec = plan_.spec.reference;
  if (spec.kind == ReferenceSpec::Kind::baseline) {
    spec.frames = kBaselineFrames;
    spec.average = true;
  }
  for (const std::string& name : spec.match)
    if (!param_of(row.plan->graph, name))
      diagnostics_.error("unknown-param", spec.where, "'match' names " + in_quotes(name) + ", which the graph has not");
  Linked linked = link_changes(graph, registry_, changes_for(row), plan_.scenes[plan_.views[row.view].scene]->scene);
  for (const Diagnostic& problem : linked.diagnostics.all())
    if (problem.severity == Severity::error)
      diagnostics_.error(problem.code, problem.where.line == 0 && spec.where.line > 0 ? spec.where : problem.where,
                         "the reference: " + problem.message, problem.hint);
  if (diagnostics_.has_errors()) return std::nullopt;
  (void)judged_output(linked.plan->graph, plan_.spec.output);
  PlannedReference reference;
  reference.view = row.view;
  reference.kind = spec.kind;
  reference.note = describe(linked.plan->graph, spec, what);
  reference.plan = std::move(linked.plan);
  reference.seed = spec.seed;
  reference.frames = spec.frames;
  reference.average = spec.average;
  reference.key = key_of(reference);
  return reference;
}

std::string ReferencePlanner::key_of(const PlannedReference& reference) const {
  const PlannedView& view = plan_.views[reference.view];
  const LoadedScene& scene = *plan_.scenes[view.scene];
  Hasher hasher;
  hasher.text(cell_key({.plan = &*reference.plan,
                        .scene = &scene.scene,
                        .scene_hash = scene.hash,
                        .camera = view.camera,
                        .seed = reference.seed,
                        .first_frame = plan_.spec.first_frame,
                        .frames = plan_.spec.frames,
                        .kept = plan_.spec.judged,
                        .frames_per_second = plan_.spec.frames_per_second,
                        .output = plan_.spec.output,
                        .code_hash = plan_.code_hash},
                       device_));
  hasher.number(reference.frames);
  hasher.number(reference.average ? 1 : 0);
  return hex(hasher.value());
}

void ReferencePlanner::add(PlannedRow& row, PlannedReference reference) {
  const std::string name = std::to_string(reference.view) + " " + reference.key;
  const auto [entry, is_new] = found_.try_emplace(name, plan_.references.size());
  if (is_new) plan_.references.push_back(std::move(reference));
  row.reference = entry->second;
}

}  // namespace lightloom::study
