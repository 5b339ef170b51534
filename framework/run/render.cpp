#include "framework/run/render.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "framework/run/provenance.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/run/version.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// Times and warnings that gather while frames are rendered.
struct Progress {
  std::vector<std::vector<PassTime>> pass_times;
  std::vector<PassTime> once_times;
  std::vector<double> wall_milliseconds;
};

Json run_record(const RenderRequest& request, const Executor& executor, const scene::Scene& scene,
                const std::optional<scene::CameraPath>& path, const gpu::Device& device, const Progress& progress,
                const std::vector<std::string>& warnings) {
  Json record;
  record["lightloom"] = version();
  record["commit"] = commit();
  record["command_line"] = request.command_line;
  record["plugins"] = plugin_records(request.plugins);
  record["graph"] = graph_record(executor.plan());
  record["graph"]["file"] = request.graph.generic_string();
  record["scene"] = scene_record(scene);
  record["camera"] = scene.cameras[find_camera(scene, request.camera)].name;
  record["camera_path"] = camera_path_record(path);
  record["seed"] = request.seed;
  record["frames"] = {{"first", request.first_frame}, {"last", request.last_frame}};
  record["frames_per_second"] = request.frames_per_second;
  record["dump_format"] = to_string(request.dump_format);
  record["device"] = device_record(device.info());
  record["validation"] = device.validating();
  record["value_memory_bytes"] = executor.value_bytes();
  record["shared_memory"] = sharing_records(executor.memory_sharing());
  record["frame_wall_ms"] = {{"median", median(progress.wall_milliseconds)}, {"frames", progress.wall_milliseconds}};
  record["hoisted"] = once_records(executor.plan(), progress.once_times);
  record["passes"] = pass_records(executor.plan(), progress.pass_times);
  record["warnings"] = warnings;
  return record;
}

Progress render_frames(const RenderRequest& request, const scene::Scene& scene, Executor& executor, RunFolder& folder,
                       const FrameCallback& on_frame) {
  Progress progress;
  if (!executor.plan().graph.captures.empty()) folder.write_moving_triangles(scene);
  const uint32_t total = request.last_frame - request.first_frame + 1;
  for (uint32_t done = 0; done < total; ++done) {
    const Clock::time_point start = Clock::now();
    const FrameResult result = executor.run_frame(request.first_frame + done);
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
    progress.wall_milliseconds.push_back(elapsed.count());
    progress.pass_times.push_back(result.times);
    if (done == 0) progress.once_times = result.once_times;
    folder.write_frame(executor.plan().graph, result, frame_record(result, request.seed, scene.bounds));
    if (on_frame) on_frame(done + 1, total);
  }
  return progress;
}

std::vector<std::string> validation_warnings(const gpu::Device& device) {
  std::vector<std::string> warnings;
  for (const gpu::ValidationMessage& message : device.validation_messages())
    warnings.push_back("validation: " + message.text);
  return warnings;
}

/// The pictures a person would open: 8-bit images, else every output of the frames.
std::vector<std::filesystem::path> pictures(const RunFolder& folder) {
  std::vector<std::filesystem::path> images;
  for (const std::filesystem::path& file : folder.files())
    if (file.extension() == ".png") images.push_back(folder.path() / file);
  return images;
}

}  // namespace

bool render(const RenderRequest& request, const PassRegistry& registry, const FrameCallback& on_frame,
            Diagnostics& diagnostics, RenderSummary& summary) {
  const scene::Scene scene = scene::load_scene(request.scene);
  std::optional<scene::CameraPath> path;
  if (!request.camera_path.empty()) path = scene::read_camera_path(request.camera_path);
  std::optional<Plan> plan = compile_graph(request.graph, registry, request.link, &scene, diagnostics);
  if (!plan) return false;
  gpu::Device device(request.device);
  Executor executor(device, std::move(*plan), scene,
                    {.shaders = request.shaders,
                     .camera = request.camera,
                     .camera_path = path,
                     .seed = request.seed,
                     .frames_per_second = request.frames_per_second,
                     .share_memory = request.share_memory});
  RunFolder folder(request.out, request.dump_format);
  const Progress progress = render_frames(request, scene, executor, folder, on_frame);
  summary.folder = folder.path();
  summary.images = pictures(folder);
  summary.warnings = scene.warnings;
  for (const std::vector<std::string>& more : {executor.scene_warnings(), validation_warnings(device)})
    summary.warnings.insert(summary.warnings.end(), more.begin(), more.end());
  summary.milliseconds_per_frame = median(progress.wall_milliseconds);
  folder.finish(run_record(request, executor, scene, path, device, progress, summary.warnings));
  return true;
}

}  // namespace lightloom::run
