#include "framework/study/plan_study.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/compute_types.hpp"
#include "framework/run/scene_resources.hpp"
#include "framework/study/fingerprint.hpp"
#include "framework/study/linked_graph.hpp"
#include "framework/study/plan_reference.hpp"
#include "framework/study/render_cell.hpp"

namespace lightloom::study {
namespace {

std::string scene_name(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  for (const char* extension : {".scene.json", ".gltf", ".glb"})
    if (name.ends_with(extension)) return name.substr(0, name.size() - std::string(extension).size());
  return name;
}

std::vector<std::unique_ptr<LoadedScene>> load_scenes(const StudySpec& spec, const scene::LoadOptions& options) {
  std::vector<std::unique_ptr<LoadedScene>> scenes;
  std::map<std::string, uint32_t> names;
  for (const SceneChoice& choice : spec.scenes) ++names[scene_name(choice.file)];
  for (const SceneChoice& choice : spec.scenes) {
    auto loaded = std::make_unique<LoadedScene>();
    loaded->file = choice.file;
    loaded->name = scene_name(choice.file);
    if (names[loaded->name] > 1) loaded->name = choice.file.generic_string();
    loaded->scene = scene::load_scene(choice.file, options);
    loaded->memo = std::make_shared<run::SceneMemo>();
    loaded->hash = scene_hash(loaded->scene);
    scenes.push_back(std::move(loaded));
  }
  return scenes;
}

std::vector<PlannedView> find_views(const StudySpec& spec, const std::vector<std::unique_ptr<LoadedScene>>& scenes) {
  std::vector<PlannedView> views;
  for (size_t i = 0; i < scenes.size(); ++i) {
    std::vector<std::string> cameras = spec.scenes[i].cameras;
    if (cameras.empty()) cameras.emplace_back();
    for (const std::string& camera : cameras)
      views.push_back({i, scenes[i]->scene.cameras[run::find_camera(scenes[i]->scene, camera)].name});
  }
  return views;
}

class Planner {
 public:
  Planner(const StudySpec& spec, const StudyEnvironment& environment, Diagnostics& diagnostics)
      : environment_(environment),
        registry_(environment.registry),
        device_(environment.device),
        diagnostics_(diagnostics) {
    plan_.spec = spec;
    plan_.shaders = run::shader_folders_with(environment.plugins);
    if (!environment.cache) plan_.shaders.cache.clear();
    std::vector<std::filesystem::path> libraries;
    for (const run::LoadedPlugin& plugin : environment.plugins) libraries.push_back(plugin.file);
    plan_.code_hash = code_hash(plan_.shaders.sources, libraries);
    for (uint32_t i = spec.frames - spec.judged; i < spec.frames; ++i)
      plan_.judged_frames.push_back(spec.first_frame + i);
  }

  std::optional<StudyPlan> plan() {
    graph_ = run::read_graph(plan_.spec.graph, registry_, plan_.shaders, diagnostics_);
    if (!graph_ || diagnostics_.has_errors()) return std::nullopt;
    plan_.scenes = load_scenes(plan_.spec, environment_.load);
    plan_.views = find_views(plan_.spec, plan_.scenes);
    const std::vector<std::string> passes = running_passes();
    if (diagnostics_.has_errors()) return std::nullopt;
    std::optional<Settings> settings = expand_settings(plan_.spec, passes, diagnostics_);
    if (!settings) return std::nullopt;
    plan_.settings = std::move(*settings);
    for (size_t view = 0; view < plan_.views.size(); ++view)
      for (size_t setting = 0; setting < plan_.settings.list.size(); ++setting) add_row(view, setting);
    if (diagnostics_.has_errors()) return std::nullopt;
    ReferencePlanner(plan_, *graph_, registry_, device_, diagnostics_).run();
    if (diagnostics_.has_errors()) return std::nullopt;
    add_cells();
    return std::move(plan_);
  }

 private:
  /// Passes of the baseline that run in some scene, in the graph's order.
  std::vector<std::string> running_passes() {
    Changes changes = plan_.spec.changes;
    for (const Axis& axis : plan_.spec.sweep) changes = combine(changes, axis.choices.front().changes);
    std::set<std::string> running;
    for (const auto& scene : plan_.scenes) {
      const Linked linked = link_changes(*graph_, registry_, changes, scene->scene);
      if (!linked.plan) report(linked, {}, "the graph");
      if (!linked.plan) return {};
      for (const GraphPass& pass : linked.plan->graph.passes) running.insert(pass.name);
    }
    std::vector<std::string> names;
    for (const PassSpec& pass : graph_->passes)
      if (running.contains(pass.name)) names.push_back(pass.name);
    return names;
  }

  /// Mistakes of options get the place in the study that made them.
  void report(const Linked& linked, const SourceLocation& where, const std::string& what) {
    for (const Diagnostic& problem : linked.diagnostics.all())
      if (problem.severity == Severity::error)
        diagnostics_.error(problem.code, problem.where.line == 0 && where.line > 0 ? where : problem.where,
                           what + ": " + problem.message, problem.hint);
  }

  void add_row(size_t view, size_t setting) {
    const Setting& chosen = plan_.settings.list[setting];
    const LoadedScene& scene = *plan_.scenes[plan_.views[view].scene];
    const Changes changes = combine(plan_.spec.changes, chosen.changes);
    PlannedRow row{setting, view, std::nullopt, {}, 0, command(view, changes)};
    Linked linked = link_changes(*graph_, registry_, changes, scene.scene);
    if (linked.plan) {
      (void)judged_output(linked.plan->graph, plan_.spec.output);
      row.plan = std::move(linked.plan);
    } else if (setting > 0 && linked.is_graphs_fault()) {
      row.error = linked.first_error();
    } else {
      report(linked, chosen.where, "setting '" + chosen.name + "'");
    }
    plan_.rows.push_back(std::move(row));
  }

  std::vector<std::string> command(size_t view, const Changes& changes) const {
    const StudySpec& spec = plan_.spec;
    const uint32_t last = spec.first_frame + spec.frames - 1;
    std::vector<std::string> words = {"lightloom",
                                      "render",
                                      spec.graph.generic_string(),
                                      "--scene",
                                      plan_.scenes[plan_.views[view].scene]->file.generic_string(),
                                      "--camera",
                                      plan_.views[view].camera,
                                      "--frames",
                                      std::to_string(spec.first_frame) + ".." + std::to_string(last),
                                      "--seed",
                                      std::to_string(spec.seeds.front())};
    if (spec.frames_per_second != 30) {
      std::ostringstream rate;
      rate.precision(17);
      rate << spec.frames_per_second;
      words.insert(words.end(), {"--fps", rate.str()});
    }
    for (const run::LoadedPlugin& plugin : environment_.plugins)
      words.insert(words.end(), {"--plugin", plugin.file.generic_string()});
    for (std::string& option : load_arguments()) words.push_back(std::move(option));
    for (std::string& option : command_options(changes)) words.push_back(std::move(option));
    return words;
  }

  /// The limits that were raised or lowered: the render would be refused without them.
  [[nodiscard]] std::vector<std::string> load_arguments() const {
    std::vector<std::string> words;
    for (const LimitInfo& info : limit_table()) {
      const uint64_t value = environment_.load.limits.*info.value;
      if (value != Limits{}.*info.value)
        words.insert(words.end(), {"--limit", std::string(info.name) + "=" + std::to_string(value)});
    }
    if (environment_.load.allow_outside) words.emplace_back("--allow-outside");
    return words;
  }

  void add_cells() {
    const StudySpec& spec = plan_.spec;
    for (const uint32_t seed : spec.seeds)
      for (size_t i = 0; i < plan_.rows.size(); ++i) {
        const PlannedRow& row = plan_.rows[i];
        if (!row.plan) continue;
        const PlannedView& view = plan_.views[row.view];
        const LoadedScene& scene = *plan_.scenes[view.scene];
        const std::string key = cell_key({.plan = &*row.plan,
                                          .scene = &scene.scene,
                                          .scene_hash = scene.hash,
                                          .camera = view.camera,
                                          .seed = seed,
                                          .first_frame = spec.first_frame,
                                          .frames = spec.frames,
                                          .kept = spec.judged,
                                          .frames_per_second = spec.frames_per_second,
                                          .output = spec.output,
                                          .code_hash = plan_.code_hash},
                                         device_);
        plan_.cells.push_back({i, seed, key});
      }
  }

  const StudyEnvironment& environment_;
  const PassRegistry& registry_;
  const gpu::DeviceInfo& device_;
  Diagnostics& diagnostics_;
  std::optional<GraphSpec> graph_;
  StudyPlan plan_;
};

}  // namespace

std::optional<StudyPlan> plan_study(const StudySpec& spec, const StudyEnvironment& environment,
                                    Diagnostics& diagnostics) {
  return Planner(spec, environment, diagnostics).plan();
}

}  // namespace lightloom::study
