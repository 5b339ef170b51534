#include <iomanip>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "framework/base/text.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/text_layout.hpp"
#include "framework/run/provenance.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::cli {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

struct SceneOptions {
  std::filesystem::path file;
  LimitOptions limits;
  bool json = false;
};

std::string text_of(const glm::vec3& vector) {
  std::ostringstream text;
  text.precision(4);
  text << vector.x << ' ' << vector.y << ' ' << vector.z;
  return text.str();
}

std::string text_of(double number) {
  std::ostringstream text;
  text.precision(4);
  text << number;
  return text.str();
}

std::string_view name_of(scene::PunctualType type) {
  switch (type) {
    case scene::PunctualType::point:
      return "point";
    case scene::PunctualType::spot:
      return "spot";
    case scene::PunctualType::directional:
      break;
  }
  return "directional";
}

std::string environment_text(const scene::Environment& environment) {
  if (environment.width == 0) return "constant, radiance " + text_of(environment.radiance);
  return "image " + std::to_string(environment.width) + "x" + std::to_string(environment.height) + ", scaled by " +
         text_of(environment.radiance);
}

std::string feature_list(const scene::Features& features) {
  std::vector<std::string> present;
  for (const auto& [name, has] : features.named()) {
    if (has) present.push_back(name);
  }
  return present.empty() ? "none" : join(present, ", ");
}

void print_text(const scene::Scene& scene, std::ostream& out) {
  std::vector<std::vector<std::string>> rows = {
      {"file", scene.file.string()},
      {"triangles", std::to_string(scene.triangles.size()) + " (" +
                        std::to_string(scene.triangles.size() - scene.static_triangle_count) + " dynamic)"},
      {"vertices", std::to_string(scene.vertices.size())},
      {"objects", std::to_string(scene.objects.size())},
      {"materials", std::to_string(scene.materials.size())},
      {"images", std::to_string(scene.images.size())},
      {"bounds", text_of(scene.bounds.min) + " to " + text_of(scene.bounds.max) + " m"},
      {"animation", scene.duration > 0 ? text_of(scene.duration) + " s" : "none"},
  };
  if (scene.origin != glm::dvec3(0)) {
    std::ostringstream origin;
    origin << std::setprecision(12) << scene.origin.x << ' ' << scene.origin.y << ' ' << scene.origin.z;
    rows.push_back({"origin", origin.str() + " m in the world; bounds and all coordinates in images are from there"});
  }
  if (scene.sun) {
    rows.push_back(
        {"sun", "direction " + text_of(scene.sun->direction) + ", irradiance " + text_of(scene.sun->irradiance)});
  }
  rows.push_back({"environment", environment_text(scene.environment)});
  for (const scene::PunctualLight& light : scene.punctual) {
    rows.push_back({"light", in_quotes(light.name) + " (" + std::string(name_of(light.type)) + ")"});
  }
  for (const scene::Camera& camera : scene.cameras) {
    const double degrees = static_cast<double>(camera.vertical_fov) * kDegreesPerRadian;
    rows.push_back({"camera", in_quotes(camera.name) + (camera.perspective ? ", " + text_of(degrees) + " degrees high"
                                                                           : std::string(", orthographic"))});
  }
  rows.push_back({"features", feature_list(scene.features)});
  out << align_columns(rows);
}

nlohmann::ordered_json to_json(const scene::Scene& scene) {
  nlohmann::ordered_json record = run::scene_record(scene);
  record["objects"] = scene.objects;
  record["duration_seconds"] = scene.duration;
  record["cameras"] = nlohmann::ordered_json::array();
  for (const scene::Camera& camera : scene.cameras) record["cameras"].push_back(camera.name);
  record["lights"] = nlohmann::ordered_json::array();
  for (const scene::PunctualLight& light : scene.punctual) {
    record["lights"].push_back({{"name", light.name}, {"type", name_of(light.type)}});
  }
  record["warnings"] = scene.warnings;
  return record;
}

ExitCode describe(const SceneOptions& options, const CommandContext& context) {
  const scene::Scene scene = scene::load_scene(options.file, options.limits.load_options());
  for (const std::string& warning : scene.warnings) print_warning(context.err, warning);
  if (options.json) {
    context.out << to_json(scene).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else {
    print_text(scene, context.out);
  }
  return ExitCode::done;
}

}  // namespace

void add_scene_command(Command& program, const CommandContext& context) {
  Command& command = program.command("scene", "Describe a scene: geometry, cameras, lights, features");
  command.description("Loads the whole scene. Exits with 0 if it can be rendered and with 3 if it is invalid.");
  auto options = std::make_shared<SceneOptions>();
  command.positional("FILE", options->file, "Scene: .gltf, .glb or .scene.json").required();
  command.flag("--json", options->json, "Print JSON");
  options->limits.add_to(command);
  command.action([options, &context] { return describe(*options, context); });
}

}  // namespace lightloom::cli
