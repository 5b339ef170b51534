#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/gpu/device.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/plugins.hpp"
#include "framework/run/scene_memo.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/scene/load_options.hpp"
#include "framework/scene/scene.hpp"
#include "framework/study/settings.hpp"
#include "framework/study/study_spec.hpp"

namespace lightloom::study {

struct LoadedScene {
  std::filesystem::path file;
  std::string name;  ///< of the file, without extensions; the path where two scenes have that name
  scene::Scene scene;
  std::shared_ptr<run::SceneMemo> memo;
  uint64_t hash = 0;
};

struct PlannedView {
  size_t scene = 0;
  std::string camera;
};

/// What rows of one view and size are measured against.
struct PlannedReference {
  std::string key;
  size_t view = 0;
  ReferenceSpec::Kind kind = ReferenceSpec::Kind::graph;
  std::optional<Plan> plan;                   ///< empty for an image
  std::vector<std::filesystem::path> images;  ///< one a judged frame, for an image
  uint32_t seed = 0;
  uint32_t frames = 1;
  bool average = false;
  std::string note;
};

/// A setting in a view.
struct PlannedRow {
  size_t setting = 0;
  size_t view = 0;
  std::optional<Plan> plan;
  std::string error;     ///< why there is no plan
  size_t reference = 0;  ///< index; means nothing with an error
  std::vector<std::string> command;
};

struct PlannedCell {
  size_t row = 0;
  uint32_t seed = 0;
  std::string key;
};

/// All that a study will run, before it runs.
struct StudyPlan {
  StudySpec spec;
  Settings settings;
  std::vector<std::unique_ptr<LoadedScene>> scenes;
  std::vector<PlannedView> views;
  std::vector<PlannedReference> references;
  std::vector<PlannedRow> rows;    ///< by view, then by setting; the baseline of a view first
  std::vector<PlannedCell> cells;  ///< seed by seed, so that what disturbs the machine meets all settings alike
  std::vector<uint32_t> judged_frames;
  run::ShaderFolders shaders;
  uint64_t code_hash = 0;
};

/// What a study runs with.
struct StudyEnvironment {
  const PassRegistry& registry;
  gpu::DeviceInfo device;
  std::vector<run::LoadedPlugin> plugins = {};
  scene::LoadOptions load = {};  ///< what the files of scenes may ask for
  bool cache = true;             ///< compiled shaders and pipelines are kept on disk
};

/// Loads the scenes, links every setting in every view and says what each cell depends on. A setting whose own graph
/// cannot be linked (a disabled pass that nothing can replace) is a row with an error; everything else that is wrong
/// goes to `diagnostics`, and the result is empty. Throws Error for files that cannot be read, and unknown cameras.
[[nodiscard]] std::optional<StudyPlan> plan_study(const StudySpec& spec, const StudyEnvironment& environment,
                                                  Diagnostics& diagnostics);

}  // namespace lightloom::study
