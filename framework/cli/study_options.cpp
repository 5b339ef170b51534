#include "framework/cli/study_options.hpp"

#include <algorithm>

#include "framework/base/file.hpp"
#include "framework/base/text.hpp"

namespace lightloom::cli {
namespace {

using study::ReferenceSpec;
using study::StudySpec;

/// Names in a list with commas; empty entries count for nothing.
std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> names = split(text, ',');
  std::erase(names, "");
  return names;
}

study::Size to_size(const Size& size) {
  return {size.width, size.height};
}

/// One axis of --sweep NAME=A,B,C.
study::Axis axis_of(const Assignment& sweep) {
  study::Axis axis{sweep.name, {}, {"--sweep", 0, 0}};
  for (const std::string& value : listed(sweep.value)) {
    study::Choice choice{value, {}, axis.where};
    if (sweep.name == "size" || sweep.name == "trace_size") {
      const auto size = study::parse_size(value);
      if (!size) throw Error(ExitCode::usage, "option '--sweep': " + in_quotes(value) + " is no size, WIDTHxHEIGHT");
      (sweep.name == "size" ? choice.changes.size : choice.changes.trace_size) = size;
    } else if (sweep.name == "general") {
      if (value != "true" && value != "false")
        throw Error(ExitCode::usage, "option '--sweep': 'general' is true or false, not " + in_quotes(value));
      choice.changes.general = value == "true";
    } else {
      choice.changes.sets = {{sweep.name, value}};
    }
    axis.choices.push_back(std::move(choice));
  }
  if (axis.choices.empty())
    throw Error(ExitCode::usage, "option '--sweep': " + in_quotes(sweep.name) + " has no values",
                "for instance --sweep paths=1,2,4");
  return axis;
}

void apply_reference(const StudyOptions& options, StudySpec& spec) {
  ReferenceSpec& reference = spec.reference;
  const auto changed = !options.reference_sets.empty() || options.reference_frames;
  if (!options.reference.empty()) {
    reference = {};
    if (options.reference.extension() == ".json") {
      reference.kind = ReferenceSpec::Kind::graph;
      reference.graph = options.reference;
    } else {
      reference.kind = ReferenceSpec::Kind::image;
      reference.image = options.reference.string();
    }
  } else if (options.study.empty()) {
    // A graph called reference.json beside the one that is studied is its reference.
    std::error_code ignored;
    const std::filesystem::path beside = options.graph.parent_path() / "reference.json";
    if (std::filesystem::is_regular_file(beside, ignored)) {
      reference.kind = ReferenceSpec::Kind::graph;
      reference.graph = beside;
    }
  }
  if (changed && (reference.kind == ReferenceSpec::Kind::image || reference.kind == ReferenceSpec::Kind::baseline))
    throw Error(ExitCode::usage, "options '--reference-set' and '--reference-frames' need a reference that is rendered",
                "name its graph with --reference");
  for (const Assignment& set : options.reference_sets) reference.changes.sets.emplace_back(set.name, set.value);
  if (options.reference_frames) reference.frames = *options.reference_frames;
}

void apply_settings(const StudyOptions& options, StudySpec& spec) {
  if (!options.ablate.empty()) {
    spec.ablate = listed(options.ablate);
    spec.ablate_where = {"--ablate", 0, 0};
    spec.factorial = false;
  }
  if (options.factorial && spec.ablate.empty())
    throw Error(ExitCode::usage, "option '--factorial' needs '--ablate', the passes to combine");
  spec.factorial = spec.factorial || options.factorial;
  for (const Assignment& sweep : options.sweeps) spec.sweep.push_back(axis_of(sweep));
  if (options.one_at_a_time) spec.crossed = false;
  study::Changes changes;
  changes.variants = options.variants;
  changes.disables = options.disables;
  for (const Assignment& set : options.sets) changes.sets.emplace_back(set.name, set.value);
  for (const Assignment& store : options.stores) changes.formats.emplace_back(store.name, store.value);
  for (const Assignment& swap : options.swaps) changes.swaps.emplace_back(swap.name, swap.value);
  if (options.size) changes.size = to_size(*options.size);
  if (options.trace_size) changes.trace_size = to_size(*options.trace_size);
  if (options.general) changes.general = true;
  spec.changes = study::combine(std::move(spec.changes), changes);
}

void apply_frames(const StudyOptions& options, StudySpec& spec) {
  if (options.frames) spec.frames = *options.frames;
  if (options.warm_up) spec.warm_up = *options.warm_up;
  if (spec.warm_up >= spec.frames) {
    if (options.warm_up)
      throw Error(ExitCode::usage,
                  "option '--warm-up' must be less than the number of frames, " + std::to_string(spec.frames));
    spec.warm_up = spec.frames - 1;
  }
  spec.judged = std::min(spec.judged, spec.frames);
  if (options.seeds) {
    spec.seeds.clear();
    for (uint32_t seed = 0; seed < *options.seeds; ++seed) spec.seeds.push_back(seed);
  }
}

void apply_metrics(const StudyOptions& options, StudySpec& spec) {
  if (options.metrics.empty()) return;
  spec.metrics = listed(options.metrics);
  const std::vector<std::string>& known = study::metric_names();
  for (const std::string& metric : spec.metrics)
    if (std::find(known.begin(), known.end(), metric) == known.end())
      throw Error(ExitCode::usage, "option '--metrics': there is no metric " + in_quotes(metric),
                  did_you_mean(metric, known, "metrics"));
}

StudySpec spec_of_options(const StudyOptions& options) {
  if (options.graph.empty() || options.scenes.empty())
    throw Error(ExitCode::usage, "a study needs a file, or '--graph' and '--scene'",
                "for instance: lightloom study --graph graphs/paper.json --scene FILE --ablate 'denoise_*'");
  StudySpec spec;
  spec.graph = options.graph;
  spec.name = options.graph.stem().string() + (options.ablate.empty() ? "_study" : "_ablation");
  for (const std::filesystem::path& scene : options.scenes) spec.scenes.push_back({scene, options.cameras});
  return spec;
}

}  // namespace

void StudyOptions::add_to(Command& command) {
  const auto group = [](Option& option, const char* heading) -> Option& { return option.group(heading); };
  command.positional("STUDY", study, "Study file (JSON); docs/studies.md describes it");
  constexpr const char* kSubject = "What is studied, without a file";
  group(command.option("--graph", graph, "Graph file (JSON)"), kSubject);
  group(command.option("--scene", scenes, "Scene: .gltf, .glb or .scene.json; may be given again"), kSubject);
  group(command.option("--camera", cameras, "Camera by name; the first unless given; may be given again"), kSubject)
      .placeholder("NAME");
  constexpr const char* kSettings = "Settings to compare";
  group(command.option("--ablate", ablate, "Passes to switch off, each alone: names or patterns, with commas between"),
        kSettings)
      .placeholder("GLOBS");
  group(command.flag("--factorial", factorial, "Every combination of the passes of --ablate instead"), kSettings);
  group(
      command.option("--sweep", sweeps,
                     "Values of a param (paths=1,2,4 or trace.march=sphere,cube_exit), of size, trace_size or general; "
                     "given again, all combinations"),
      kSettings)
      .placeholder("NAME=VALUES");
  group(command.flag("--one-at-a-time", one_at_a_time, "Vary one --sweep at a time, not all together"), kSettings);
  constexpr const char* kMeasure = "How it is measured";
  group(
      command.option("--reference", reference,
                     "Ground truth: a graph file, or an OpenEXR image; unless given, reference.json beside the graph, "
                     "else the mean of the baseline"),
      kMeasure);
  group(command.option("--reference-set", reference_sets, "Set a parameter of the reference's graph"), kMeasure);
  group(command.option("--reference-frames", reference_frames, "Frames of the reference").range(1, study::kMostFrames),
        kMeasure);
  group(command.option("--seeds", seeds, "Number of seeds, from 0 on").range(1, study::kMostSeeds), kMeasure);
  group(command.option("--frames", frames, "Frames of each cell; the last is judged").range(1, study::kMostFrames),
        kMeasure);
  group(command.option("--warm-up", warm_up, "Frames at the beginning that are not timed").range(0, study::kMostFrames),
        kMeasure);
  group(command.option("--metrics", metrics, "Metrics, with commas between; the first one ranks"), kMeasure)
      .placeholder("NAMES");
  constexpr const char* kChanges = "Changes to the graph, for all settings";
  group(command.option("--variant", variants, "Apply a variant that the graph declares"), kChanges).placeholder("NAME");
  group(command.option("--set", sets, "Set a parameter of the graph or of a pass"), kChanges);
  group(command.option("--store", stores,
                       "Format in which values are stored, by PASS.PORT or PASS.PORT.PART, or a pattern"),
        kChanges)
      .placeholder("GLOB=FORMAT");
  group(command.option("--disable", disables, "Disable the passes that match"), kChanges).placeholder("GLOB");
  group(command.option("--swap", swaps, "Exchange the type of the passes that match"), kChanges)
      .placeholder("GLOB=TYPE");
  group(command.flag("--general", general, "Model all that any scene could need"), kChanges);
  group(command.option("--size", size, "View size in pixels"), kChanges);
  group(command.option("--trace-size", trace_size, "Size in pixels at which is traced"), kChanges);
  command.option("-o,--out", out, "Folder of the study, made if missing")
      .placeholder("DIR")
      .default_text("out/ and the study's name");
  limits.add_to(command);
  cache.add_to(command);
  command.option("--jobs", jobs, "Cells rendered at the same time; more than 1 spoils the times")
      .range(1, study::kMostJobs);
  command.option("--device", device, "Device by index or part of its name").placeholder("NAME");
  command.flag("--fresh", fresh, "Forget the cells of earlier runs");
  command.flag("--dry-run", dry_run, "List the cells and how long they will take, and run none");
  command.flag("--no-times", no_times, "Leave out of the results what depends on a clock; no report");
}

std::optional<StudySpec> study_spec(const StudyOptions& options, Diagnostics& diagnostics) {
  std::optional<StudySpec> spec;
  if (options.study.empty()) {
    spec = spec_of_options(options);
  } else {
    if (!options.graph.empty() || !options.scenes.empty() || !options.cameras.empty())
      throw Error(ExitCode::usage,
                  "a study file names its graph and scenes; '--graph', '--scene' and '--camera' cannot",
                  "leave the file or the options out");
    spec = study::parse_study(read_text_file(options.study), options.study, diagnostics);
  }
  if (!spec) return std::nullopt;
  apply_reference(options, *spec);
  apply_settings(options, *spec);
  apply_frames(options, *spec);
  apply_metrics(options, *spec);
  if (options.jobs) spec->jobs = *options.jobs;
  return spec;
}

}  // namespace lightloom::cli
