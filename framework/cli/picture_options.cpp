#include "framework/cli/picture_options.hpp"

namespace lightloom::cli {
namespace {

constexpr double kMostFramesPerSecond = 1e6;

std::string check_frames(std::string_view text) {
  Range frames;
  if (std::string problem = parse_value(text, frames); !problem.empty()) return problem;
  return frames.last <= kLastFrame ? "" : "frames end at " + std::to_string(kLastFrame);
}

std::string check_folder(std::string_view text) {
  std::error_code ignored;
  return std::filesystem::is_directory(text, ignored) ? "" : "there is no folder '" + std::string(text) + "'";
}

}  // namespace

void add_shaders_option(Command& command, std::vector<std::filesystem::path>& folders) {
  command.option("--shaders", folders, "Folder that is searched for shaders first: those there replace the program's")
      .placeholder("DIR")
      .check(check_folder);
}

void PictureOptions::add_graph_to(Command& command) {
  command.positional("GRAPH", graph, "Graph file (JSON)").required();
}

void PictureOptions::add_to(Command& command) {
  const auto group = [](Option& option) -> Option& { return option.group("Scene and frames"); };
  group(command.option("--scene", scene, "Scene: .gltf, .glb or .scene.json")).required();
  group(command.option("--camera", camera, "Camera of the scene by name; the first one unless given"))
      .placeholder("NAME");
  group(command.option("--camera-path", camera_path, "Keyframes that the camera follows instead (JSON)"));
  group(command.option("--frames", frames, "Frames to render, one after another; both ends included"))
      .check(check_frames);
  group(command.option("--fps", frames_per_second, "Frames a second of scene time, for animation"))
      .range(1e-6, kMostFramesPerSecond);
  group(command.option("--time", time, "Hold the scene and the camera still as they are at this time, in seconds"))
      .placeholder("SECONDS")
      .range(0, 1e6);
  group(command.option("--seed", seed, "Seed of all random numbers"));
  add_shaders_option(command, shaders);
  cache.add_to(command);
  changes.add_to(command);
  limits.add_to(command);
}

run::RenderRequest PictureOptions::request(const CommandContext& context) const {
  run::RenderRequest request;
  request.plugins = context.plugins;
  request.shaders = cache.apply_to(run::shader_folders_with(context.plugins));
  request.shaders.sources.insert(request.shaders.sources.begin(), shaders.begin(), shaders.end());
  request.graph = graph;
  request.scene = scene;
  request.load = limits.load_options();
  request.link = changes.link_options();
  request.compile = changes.compile_options();
  request.camera = camera;
  request.camera_path = camera_path;
  request.seed = seed;
  request.first_frame = frames.first;
  request.last_frame = frames.last;
  request.frames_per_second = frames_per_second;
  request.frozen_time = time;
  return request;
}

}  // namespace lightloom::cli
