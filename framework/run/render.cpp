#include "framework/run/render.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/graph/plan_json.hpp"
#include "framework/run/checkpoint.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/device_room.hpp"
#include "framework/run/executor.hpp"
#include "framework/run/frame_loop.hpp"
#include "framework/run/provenance.hpp"
#include "framework/run/run_checks.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/run/run_progress.hpp"
#include "framework/run/run_record.hpp"
#include "framework/run/version.hpp"
#include "framework/scene/content_hash.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;

/// What the steps of one render share.
struct Run {
  const RenderRequest& request;
  const std::string& graph_text;
  const scene::Scene& scene;
  const std::optional<scene::CameraPath>& path;
  std::string scene_hash;
  const gpu::Device& device;
  uint32_t total = 0;  ///< frames
  Json identity;       ///< identity_of
};

Json run_record(const Run& run, const Executor& executor, const RunChecks& checks, const RunProgress& progress,
                const std::vector<std::string>& warnings) {
  const RenderRequest& request = run.request;
  Json record;
  record["lightloom"] = version();
  record["commit"] = commit();
  record["command_line"] = request.command_line;
  record["working_directory"] = std::filesystem::current_path().generic_string();
  record["plugins"] = plugin_records(request.plugins);
  record["shaders"] = hex(shaders_hash(request.shaders));
  record["graph"] = graph_record(executor.plan());
  record["graph"]["file"] = request.graph.generic_string();
  record["graph"]["text"] = run.graph_text;
  record["link"] = link_record(request.link);
  record["scene"] = scene_record(run.scene);
  record["scene"]["content_hash"] = run.scene_hash;
  record["camera"] = run.scene.cameras[find_camera(run.scene, request.camera)].name;
  record["camera_path"] = camera_path_record(run.path);
  record["seed"] = request.seed;
  record["frames"] = {{"first", request.first_frame}, {"last", request.first_frame + progress.frames() - 1}};
  record["resumed_at"] = progress.resumed_at;
  record["frames_per_second"] = request.frames_per_second;
  record["frozen_time"] = request.frozen_time ? Json(*request.frozen_time) : Json();
  record["sync"] = to_string(request.compile.sync);
  record["pass_times"] = request.time_passes;
  record["order"] = to_string(request.compile.order, request.compile.order_seed);
  record["dump_format"] = to_string(request.dump_format);
  record["output_frames"] = to_string(request.output_frames);
  record["dump_frames"] = to_string(request.dump_frames);
  record["device"] = device_record(run.device.info());
  record["validation"] = run.device.validating();
  record["value_memory_bytes"] = executor.value_bytes();
  record["shared_memory"] = sharing_records(executor.memory_sharing());
  record["frame_wall_ms"] = {{"median", median(progress.wall_milliseconds)}, {"frames", progress.wall_milliseconds}};
  record["timed_every"] = progress.timed_every;
  record["hoisted"] = once_records(executor.plan(), progress.once_times);
  record["passes"] = pass_records(executor.plan(), progress.pass_times);
  checks.add_to(record);
  record["warnings"] = warnings;
  return record;
}

/// All that the bits of a run depend on, in words for who resumes it with something else.
Json identity_of(const Run& run, const Plan& plan) {
  const RenderRequest& request = run.request;
  const gpu::DeviceInfo& device = run.device.info();
  const Json camera_path = camera_path_record(run.path);
  Json plugins = Json::array();
  for (const LoadedPlugin& plugin : request.plugins) plugins.push_back(plugin.name + " " + plugin.version);
  return {{"scene", run.scene_hash},
          {"seed", std::to_string(request.seed)},
          {"view size", to_string(plan.graph.view)},
          {"trace size", to_string(plan.graph.trace)},
          {"plan of the graph", hex(plan_hash(plan))},
          {"camera", run.scene.cameras[find_camera(run.scene, request.camera)].name},
          {"camera path", run.path ? hex(hash_text(camera_path.dump())) : "none"},
          {"first frame", std::to_string(request.first_frame)},
          {"frames a second", Json(request.frames_per_second).dump()},
          {"frozen time", request.frozen_time ? Json(*request.frozen_time).dump() : "none"},
          {"dump format", to_string(request.dump_format)},
          {"frames with outputs", to_string(request.output_frames)},
          {"frames with dumps", to_string(request.dump_frames)},
          {"device", device.name + ", " + device.driver_info + ", " + device.uuid_text()},
          {"plug-ins", plugins.dump()},
          {"lightloom", version() + " " + commit()}};
}

/// The checkpoint to go on from, if that was asked for and there is one.
std::optional<Checkpoint> find_checkpoint(const Run& run) {
  if (!run.request.resume) return std::nullopt;
  std::optional<Checkpoint> checkpoint = read_checkpoint(run.request.out);
  if (!checkpoint) return std::nullopt;
  require_same_run(run.request.out, checkpoint->identity, run.identity);
  const uint32_t done = checkpoint->progress.frames();
  if (done > run.total)
    throw Error(ExitCode::invalid_input,
                "the checkpoint in '" + run.request.out.string() + "' has " + std::to_string(done) +
                    " frames, more than the " + std::to_string(run.total) + " asked for",
                "resume with at least as many, or render without --resume, which starts anew");
  if (done < run.total) checkpoint->progress.resumed_at.push_back(run.request.first_frame + done);
  return checkpoint;
}

RunFolder open_folder(const RenderRequest& request, const std::optional<Checkpoint>& checkpoint) {
  if (!checkpoint) return RunFolder(request.out, request.dump_format);
  return {request.out, request.dump_format, checkpoint->folder};
}

ExecutorOptions executor_options(const Run& run, const std::shared_ptr<SceneMemo>& memo,
                                 const std::shared_ptr<ShaderLibrary>& library) {
  const RenderRequest& request = run.request;
  return with_checks({.shaders = request.shaders,
                      .camera = request.camera,
                      .camera_path = run.path,
                      .seed = request.seed,
                      .frames_per_second = request.frames_per_second,
                      .frozen_time = request.frozen_time,
                      .share_memory = request.share_memory,
                      .time_passes = request.time_passes,
                      .memo = memo,
                      .library = library},
                     request.checks);
}

Json plan_of(const Executor& executor, const gpu::Device& device) {
  PlanFacts facts;
  facts.memory = {memory_needs(device, executor.plan().graph), executor.memory_sharing()};
  return plan_json(executor.plan(), facts);
}

/// What a run writes before its first frame: the plan, and which triangles move.
std::function<void()> opening_files(const Run& run, const Executor& executor, RunFolder& folder) {
  const bool captures = !executor.plan().graph.captures.empty();
  return [&run, &folder, captures, plan = plan_of(executor, run.device)] {
    folder.write_plan(plan);
    if (captures) folder.write_moving_triangles(run.scene);
  };
}

FrameLoopOptions loop_options(const Run& run, const Executor& executor, RunChecks& checks, const RunProgress& progress,
                              RunFolder& folder, const RenderEvents& events) {
  const RenderRequest& request = run.request;
  return {.first_frame = request.first_frame,
          .total = run.total,
          .output_frames = request.output_frames,
          .dump_frames = request.dump_frames,
          .checkpoint_every = request.checkpoint_every,
          .checkpoint_time = request.checkpoint_time,
          .identity = run.identity,
          .describe = [&run](const FrameResult& frame) { return frame_record(frame, run.request.seed, run.scene); },
          .go_on_after =
              [&checks](const FrameResult& frame) {
                checks.add(frame);
                return !checks.stop();
              },
          .on_frame = events.on_frame,
          .before_first = progress.frames() == 0 ? opening_files(run, executor, folder) : nullptr,
          .on_written = events.on_written};
}

std::vector<std::string> validation_warnings(const gpu::Device& device) {
  std::vector<std::string> warnings;
  for (const gpu::ValidationMessage& message : device.validation_messages())
    warnings.push_back("validation: " + message.text);
  return warnings;
}

void summarise(const Run& run, const Executor& executor, const RunChecks& checks, const RunFolder& folder,
               const RunProgress& progress, RenderSummary& summary) {
  summary.folder = folder.path();
  if (const std::filesystem::path picture = folder.files().last_of_frames(".png"); !picture.empty())
    summary.picture = folder.path() / picture;
  summary.warnings = run.scene.warnings;
  for (const std::vector<std::string>& more :
       {executor.scene_warnings(), checks.warnings(), validation_warnings(run.device)})
    summary.warnings.insert(summary.warnings.end(), more.begin(), more.end());
  summary.failures = checks.failures();
  summary.frames = progress.frames();
  summary.milliseconds_per_frame = median(progress.wall_milliseconds);
}

}  // namespace

/// The scene, for as long as no file of it changes.
struct Renderer::LoadedScene {
  FileContents files;
  scene::Scene scene;
  std::string hash;
  std::shared_ptr<SceneMemo> memo = std::make_shared<SceneMemo>();
};

Renderer::Renderer(const PassRegistry& registry) : registry_(registry) {}
Renderer::~Renderer() = default;

/// What is read is noted before, so that a change in between is taken for one.
const std::filesystem::path& Renderer::noted(const std::filesystem::path& file) {
  files_.insert_or_assign(file, content_of(file));
  return file;
}

void Renderer::load(const RenderRequest& request) {
  if (scene_) return;
  FileContents files = scene::content_files(request.scene, request.load);
  files_.insert(files.begin(), files.end());
  scene_ = std::make_unique<LoadedScene>(LoadedScene{.files = std::move(files),
                                                     .scene = scene::load_scene(request.scene, request.load),
                                                     .hash = hex(scene::content_hash(request.scene, request.load))});
}

FileContents Renderer::files_read() const {
  FileContents files = files_;
  if (scene_) files.insert(scene_->files.begin(), scene_->files.end());
  if (library_) files.merge(library_->files_read());
  return files;
}

void Renderer::forget(const std::vector<std::filesystem::path>& changed) {
  if (library_) library_->forget(changed);
  if (scene_ && std::any_of(changed.begin(), changed.end(),
                            [&](const std::filesystem::path& file) { return scene_->files.contains(file); }))
    scene_.reset();
}

bool Renderer::render(const RenderRequest& request, const RenderEvents& events, Diagnostics& diagnostics,
                      RenderSummary& summary) {
  files_.clear();
  const std::filesystem::path& graph_file = noted(request.graph);
  std::optional<scene::CameraPath> path;
  if (!request.camera_path.empty()) path = scene::read_camera_path(noted(request.camera_path), request.load.limits);
  load(request);
  const scene::Scene& scene = scene_->scene;
  const std::string graph_text = read_text_file(graph_file);
  const std::optional<Graph> graph =
      link_text(graph_text, request.graph, registry_, request.link, &scene, diagnostics, request.shaders, &files_);
  if (!graph) return false;
  CompileOptions compile_options = request.compile;
  compile_options.scan = compile_options.scan || request.checks.any();
  Plan plan = compile(*graph, compile_options);
  if (!device_) device_ = std::make_unique<gpu::Device>(request.device);
  if (!library_) library_ = make_library(*device_, request.shaders);
  device_->clear_validation_messages();
  Run run{.request = request,
          .graph_text = graph_text,
          .scene = scene,
          .path = path,
          .scene_hash = scene_->hash,
          .device = *device_,
          .total = request.last_frame - request.first_frame + 1,
          .identity = {}};
  run.identity = identity_of(run, plan);
  if (!lock_) lock_.emplace(request.out, "render");
  const DeviceRoom room = room_of(*device_);
  try {
    const std::optional<Checkpoint> checkpoint = find_checkpoint(run);
    const ExecutorOptions options = executor_options(run, scene_->memo, library_);
    RunChecks checks(request.checks, *device_, plan, scene, options);
    Executor executor(*device_, std::move(plan), scene, options);
    if (checkpoint) {
      executor.restore(checkpoint->state);
      checks.resume(checkpoint->state);
    }
    RunFolder folder = open_folder(request, checkpoint);
    folder.replace(broken_off_);
    RunProgress progress = checkpoint ? checkpoint->progress : RunProgress{};
    summary.frames_resumed = progress.frames();
    try {
      render_frames(executor, folder, progress, loop_options(run, executor, checks, progress, folder, events));
      summary.interrupted_by = progress.frames() < run.total ? interrupt_signal() : 0;
    } catch (const Interrupted& interrupted) {
      // In the middle of a frame; those before it are whole.
      if (progress.frames() == summary.frames_resumed) throw;
      summary.interrupted_by = interrupted.signal();
    } catch (...) {
      broken_off_ = folder.leftovers();
      throw;
    }
    summarise(run, executor, checks, folder, progress, summary);
    Json record = run_record(run, executor, checks, progress, summary.warnings);
    if (summary.interrupted_by != 0)
      record["interrupted"] = {{"by", signal_name(summary.interrupted_by)}, {"frames_asked_for", run.total}};
    folder.finish(std::move(record));
    broken_off_.clear();
    library_->drop_unused();
    library_->pipelines().save();
    return true;
  } catch (const gpu::OutOfMemory& error) {
    throw with_demand(error, *graph, demand_of(*graph, scene), room);
  }
}

bool render(const RenderRequest& request, const PassRegistry& registry, const FrameCallback& on_frame,
            Diagnostics& diagnostics, RenderSummary& summary) {
  return Renderer(registry).render(request, {.on_frame = on_frame, .on_written = {}}, diagnostics, summary);
}

}  // namespace lightloom::run
