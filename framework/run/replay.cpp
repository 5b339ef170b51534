#include "framework/run/replay.hpp"

#include <algorithm>
#include <map>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/folder_lock.hpp"
#include "framework/base/hash.hpp"
#include "framework/base/text.hpp"
#include "framework/image/dumped_image.hpp"
#include "framework/image/exr.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "framework/run/provenance.hpp"
#include "framework/run/replay_inputs.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/run/run_record.hpp"
#include "framework/run/version.hpp"
#include "framework/scene/content_hash.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What the steps of a replay share.
struct Replay {
  const ReplayRequest& request;
  const RecordedRun& run;
  scene::Scene scene;
  std::optional<scene::CameraPath> path;
  uint32_t frame = 0;
};

uint32_t frame_to_replay(const RecordedRun& run, const std::optional<uint32_t>& wanted) {
  const std::vector<uint32_t>& frames = run.dumps.frames();
  if (frames.empty())
    throw Error(ExitCode::invalid_input, "nothing was dumped in the run '" + run.folder.string() + "'",
                "render it again with --dump '*'");
  if (!wanted) return frames.back();
  if (std::find(frames.begin(), frames.end(), *wanted) != frames.end()) return *wanted;
  throw Error(ExitCode::usage,
              "frame " + std::to_string(*wanted) + " of the run '" + run.folder.string() + "' was not dumped",
              "dumped frames are from " + std::to_string(frames.front()) + " to " + std::to_string(frames.back()));
}

fs::path out_folder(const ReplayRequest& request) {
  fs::path out = request.out.empty() ? request.folder / "replay" : request.out;
  std::error_code ignored;
  if (fs::equivalent(out, request.folder, ignored))
    throw Error(ExitCode::usage, "--out '" + out.string() + "' is the run itself, whose dumps are still needed");
  return out;
}

Replay open_replay(const ReplayRequest& request, const RecordedRun& run) {
  Replay replay{request, run, scene::load_scene(request.scene.empty() ? run.scene : request.scene, request.load),
                std::nullopt, 0};
  if (!run.camera_path.empty()) replay.path = scene::read_camera_path(run.camera_path, request.load.limits);
  replay.frame = frame_to_replay(run, request.frame);
  return replay;
}

std::string device_text(const gpu::DeviceInfo& device) {
  return device.name + ", " + device.driver_info + ", " + device.uuid_text();
}

/// The path that was read is named like the one of the run, wherever each was found.
bool same_path(const Replay& replay) {
  Json now = camera_path_record(replay.path);
  Json then = replay.run.camera_path_record;
  if (now.is_object()) now.erase("file");
  if (then.is_object()) then.erase("file");
  return now == then;
}

/// All that is not as it was and may change bits.
std::vector<std::string> changes_of(const Replay& replay, const std::string& graph_text,
                                    const gpu::DeviceInfo& device) {
  const ReplayRequest& request = replay.request;
  const RecordedRun& run = replay.run;
  std::vector<std::string> changes;
  for (const auto& [pass, type] : request.swaps) changes.push_back("--swap " + pass + "=" + type);
  for (const auto& [param, value] : request.sets) changes.push_back("--set " + param + "=" + value);
  if (graph_text != run.graph_text) changes.push_back("the graph, taken from '" + request.graph.string() + "'");
  if (hex(scene::content_hash(replay.scene.file, replay.request.load)) != run.scene_hash)
    changes.push_back("the scene '" + replay.scene.file.string() + "'");
  if (!same_path(replay)) changes.push_back("the camera path '" + run.camera_path.string() + "'");
  if (hex(shaders_hash(request.shaders)) != run.shaders) changes.emplace_back("the shaders");
  if (device_text(device) != run.device) changes.push_back("the device, then " + run.device);
  return changes;
}

std::vector<std::string> notes_of(const Replay& replay) {
  std::vector<std::string> notes;
  const RecordedRun& run = replay.run;
  if (const std::string now = version() + " " + commit(); now != run.program)
    notes.push_back("the run was made by Lightloom " + run.program + ", this is " + now);
  std::error_code ignored;
  if (replay.request.graph.empty() && fs::exists(run.graph, ignored) && read_text_file(run.graph) != run.graph_text)
    notes.push_back("'" + run.graph.string() +
                    "' has changed since the run; replayed is the graph as it was then (--graph " + run.graph.string() +
                    " takes the new one)");
  return notes;
}

/// What the passes write and anybody reads is to come back.
void capture_outputs(Graph& graph) {
  std::vector<ValueId> captures = graph.captures;
  for (const GraphPass& pass : graph.passes)
    for (const Use& use : pass.outputs)
      if (graph.values[use.value].read) captures.push_back(use.value);
  std::sort(captures.begin(), captures.end());
  captures.erase(std::unique(captures.begin(), captures.end()), captures.end());
  graph.captures = std::move(captures);
  mark_reads(graph);
}

ReplayedValue held_against_dump(const Replay& replay, const Value& value, const image::HostImage& image, bool compare) {
  ReplayedValue result;
  result.name = value_name(value);
  result.channels = image::default_channel_names(value.desc, value.port, value.part);
  const Extent3& extent = value.desc.extent;
  result.texels = uint64_t{extent.width} * extent.height * extent.depth;
  const std::optional<fs::path> file = replay.run.dumps.file(replay.frame, result.name);
  result.dumped = file.has_value();
  if (compare && file)
    result.difference = image::bit_difference(image, image::read_dumped(*file, value.desc, result.channels));
  return result;
}

void compare(const Replay& replay, const Graph& graph, const FrameResult& result, ReplaySummary& summary) {
  for (const NamedImage& capture : result.captures) {
    const auto value = std::find_if(graph.values.begin(), graph.values.end(),
                                    [&](const Value& candidate) { return value_name(candidate) == capture.name; });
    summary.values.push_back(held_against_dump(replay, *value, capture.image, summary.compared));
    const ReplayedValue& last = summary.values.back();
    if (last.difference && last.difference->texels > 0) summary.same = false;
  }
}

std::vector<PassTime> medians(const std::vector<std::vector<PassTime>>& runs) {
  std::vector<PassTime> result = runs.front();
  for (size_t pass = 0; pass < result.size(); ++pass) {
    std::vector<double> times;
    for (const std::vector<PassTime>& run : runs) times.push_back(run.at(pass).milliseconds);
    result[pass].milliseconds = median(times);
  }
  return result;
}

Json replay_record(const Replay& replay, const ReplaySummary& summary, const Plan& plan,
                   const std::vector<std::vector<PassTime>>& times) {
  return {
      {"lightloom", version()},
      {"commit", commit()},
      {"command_line", replay.request.command_line},
      {"replay", {{"of", replay.run.folder.generic_string()}, {"frame", replay.frame}, {"changes", summary.changes}}},
      {"graph", graph_record(plan)},
      {"passes", pass_records(plan, times)},
      {"warnings", summary.warnings}};
}

/// The passes that are to run, cut out of the graph of `text`; empty if `diagnostics` has errors.
std::optional<Cut> cut_out(const Replay& replay, const std::string& text, const PassRegistry& registry,
                           Diagnostics& diagnostics) {
  const ReplayRequest& request = replay.request;
  LinkOptions link = replay.run.link;
  link.swaps.insert(link.swaps.end(), request.swaps.begin(), request.swaps.end());
  link.sets.insert(link.sets.end(), request.sets.begin(), request.sets.end());
  const fs::path& file = request.graph.empty() ? replay.run.graph : request.graph;
  const std::optional<Graph> whole = link_text(text, file, registry, link, &replay.scene, diagnostics, request.shaders);
  if (!whole) return std::nullopt;
  Cut part = cut(*whole, choose_passes(*whole, request.passes));
  part.graph = for_one_frame(std::move(part.graph));
  capture_outputs(part.graph);
  return part;
}

/// Runs the passes, and again for their times.
FrameResult run_passes(Executor& executor, const Replay& replay, std::vector<std::vector<PassTime>>& times) {
  FrameResult result = executor.run_frame(replay.frame);
  times.push_back(result.times);
  while (times.size() < std::max(replay.request.repeat, 1u))
    times.push_back(executor.repeat_frame({.outputs = false, .captures = false}).times);
  return result;
}

void write_outputs(const Replay& replay, const Executor& executor, const FrameResult& result, ReplaySummary& summary,
                   const std::vector<std::vector<PassTime>>& times) {
  const FolderLock lock(out_folder(replay.request), "replay");
  RunFolder folder(out_folder(replay.request), replay.run.dump_format == "npy" ? DumpFormat::npy : DumpFormat::exr);
  const Plan& plan = executor.plan();
  folder.write_frame(plan.graph, result, frame_record(result, replay.run.seed, replay.scene));
  folder.finish(replay_record(replay, summary, plan, times));
  summary.folder = folder.path();
}

}  // namespace

bool replay(const ReplayRequest& request, const PassRegistry& registry, Diagnostics& diagnostics,
            ReplaySummary& summary) {
  const RecordedRun run = read_run(request.folder);
  static_cast<void>(out_folder(request));
  const Replay replay = open_replay(request, run);
  summary.frame = replay.frame;
  const std::string text = request.graph.empty() ? run.graph_text : read_text_file(request.graph);
  const std::optional<Cut> part = cut_out(replay, text, registry, diagnostics);
  if (!part) return false;
  const FrameStart start = start_from_dumps(run, *part, replay.frame);

  gpu::Device device(request.device);
  Executor executor(device, compile(part->graph, request.compile), replay.scene,
                    {.shaders = request.shaders,
                     .camera = run.camera,
                     .camera_path = replay.path,
                     .seed = run.seed,
                     .frames_per_second = run.frames_per_second,
                     .frozen_time = run.frozen_time});
  executor.start_at(start);
  std::vector<std::vector<PassTime>> times;
  const FrameResult result = run_passes(executor, replay, times);
  summary.times = medians(times);
  summary.notes = notes_of(replay);
  summary.changes = changes_of(replay, text, device.info());
  if (summary.changes.empty() &&
      Json::parse(frame_record(result, run.seed, replay.scene).dump()) != run.dumps.conditions(replay.frame))
    summary.changes.emplace_back("the frame's conditions: camera or time are not those in its frame.json");
  summary.compared = request.compare || summary.changes.empty();
  compare(replay, part->graph, result, summary);
  for (const gpu::ValidationMessage& message : device.validation_messages())
    summary.warnings.push_back("validation: " + message.text);
  write_outputs(replay, executor, result, summary, times);
  return true;
}

}  // namespace lightloom::run
