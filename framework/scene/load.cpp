#include "framework/scene/assemble.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/finish.hpp"

namespace lightloom::scene {
namespace {

SceneFile describe_file(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::string extension = file.extension().string();
  if (name.ends_with(".json")) return read_scene_file(file);
  if (extension != ".gltf" && extension != ".glb") {
    throw Error(ExitCode::invalid_input,
                file.string() + ": the file name ends with '" + extension + "', expected .gltf, .glb or .scene.json");
  }
  SceneFile result;
  result.instances.emplace_back().gltf = file;
  return result;
}

bool has_light(const Features& features) {
  return features.emissive || features.sun || features.punctual || features.environment;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file) {
  Scene scene = assemble(file, describe_file(file));
  scene.bounds = find_bounds(scene);
  scene.features = find_features(scene);
  if (scene.cameras.empty()) scene.cameras.push_back(framing_camera(scene.bounds));
  if (!has_light(scene.features)) {
    scene.warnings.push_back(
        "the scene has no light: give it a sun or an environment in a scene file, or everything is black");
  }
  return scene;
}

}  // namespace lightloom::scene
