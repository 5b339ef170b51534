#include "framework/scene/scene_file.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"
#include "framework/scene/images.hpp"

namespace lightloom::scene {
namespace {

[[noreturn]] void refuse(const SourceLocation& where, const std::string& sentence, std::string hint = {}) {
  throw Error(ExitCode::invalid_input,
              where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": " + sentence,
              std::move(hint));
}

/// An object whose members are read one by one; `finish` refuses those that nobody asked for.
class Members {
 public:
  Members(const JsonNode& node, std::string path) : node_(node), path_(std::move(path)) {
    if (node.kind != JsonKind::object)
      refuse(node.where, shown("") + " is " + std::string(to_string(node.kind)) + ", expected an object");
  }

  const JsonNode* find(const std::string& key) {
    known_.push_back(key);
    return node_.find(key);
  }

  const JsonNode& require(const std::string& key) {
    const JsonNode* found = find(key);
    if (!found) refuse(node_.where, shown(key) + " is missing");
    return *found;
  }

  const JsonNode& typed(const JsonNode& value, const std::string& key, JsonKind kind) const {
    if (value.kind != kind)
      refuse(value.where,
             shown(key) + " is " + std::string(to_string(value.kind)) + ", expected " + std::string(to_string(kind)));
    return value;
  }

  double number(const JsonNode& value, const std::string& key, double min, double max) const {
    if (value.kind != JsonKind::integer && value.kind != JsonKind::real) {
      refuse(value.where, shown(key) + " is " + std::string(to_string(value.kind)) + ", expected a number");
    }
    if (!std::isfinite(value.real) || value.real < min || value.real > max) {
      refuse(value.where,
             shown(key) + " is " + text(value.real) + ", expected a value from " + text(min) + " to " + text(max));
    }
    return value.real;
  }

  double number_or(const std::string& key, double fallback, double min, double max) {
    const JsonNode* value = find(key);
    return value ? number(*value, key, min, max) : fallback;
  }

  glm::vec3 vec3(const JsonNode& value, const std::string& key, double min) const {
    if (value.kind != JsonKind::array || value.elements.size() != 3)
      refuse(value.where, shown(key) + " is not an array of 3 numbers, expected one");
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) {
      result[i] = static_cast<float>(
          number(value.elements[static_cast<size_t>(i)], key + "[" + std::to_string(i) + "]", min, kLargest));
    }
    return result;
  }

  glm::vec3 vec3_or(const std::string& key, const glm::vec3& fallback, double min) {
    const JsonNode* value = find(key);
    return value ? vec3(*value, key, min) : fallback;
  }

  void finish() const {
    for (const JsonMember& member : node_.members) {
      if (std::find(known_.begin(), known_.end(), member.key) == known_.end()) {
        refuse(member.where, shown(member.key) + " is not a known member",
               did_you_mean(member.key, known_, "known are"));
      }
    }
  }

  [[nodiscard]] std::string shown(const std::string& key) const {
    if (key.empty()) return path_.empty() ? "the scene file" : path_;
    return path_.empty() ? key : path_ + "." + key;
  }

  static constexpr double kLargest = 1e12;

 private:
  static std::string text(double value) {
    std::string result = std::to_string(value);
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
    return result;
  }

  const JsonNode& node_;
  std::string path_;
  std::vector<std::string> known_;
};

std::string place(const JsonNode& node) {
  return node.where.file + ":" + std::to_string(node.where.line) + ":" + std::to_string(node.where.column);
}

InstanceSpec read_instance(const JsonNode& node, const std::filesystem::path& folder, const std::string& path) {
  Members members(node, path);
  InstanceSpec instance;
  const JsonNode& gltf = members.require("gltf");
  instance.gltf = folder / members.typed(gltf, "gltf", JsonKind::string).string;
  instance.where = place(gltf) + ": " + path;
  instance.translation = members.vec3_or("translation", glm::vec3(0), -Members::kLargest);
  instance.rotation_y = glm::radians(static_cast<float>(members.number_or("rotation_y_degrees", 0, -1e6, 1e6)));
  instance.scale = static_cast<float>(members.number_or("scale", 1, 1e-9, 1e9));
  instance.time_offset = members.number_or("time_offset_seconds", 0, -1e9, 1e9);
  if (const JsonNode* animation = members.find("animation")) {
    instance.animation_named = true;
    if (animation->kind == JsonKind::integer && animation->integer >= 0 && animation->integer < 1000000) {
      instance.animation = static_cast<int>(animation->integer);
    } else {
      instance.animation = members.typed(*animation, "animation", JsonKind::string).string;
    }
  }
  members.finish();
  return instance;
}

Camera read_camera(const JsonNode& node, const std::string& name, const std::string& path) {
  Members members(node, path);
  Camera camera;
  camera.name = name;
  const glm::vec3 eye = members.vec3(members.require("eye"), "eye", -Members::kLargest);
  const glm::vec3 target = members.vec3(members.require("target"), "target", -Members::kLargest);
  const glm::vec3 up = members.vec3_or("up", {0, 1, 0}, -Members::kLargest);
  camera.vertical_fov = glm::radians(static_cast<float>(members.number_or("vertical_fov_degrees", 45, 0.01, 179.9)));
  members.finish();
  const glm::vec3 forward = target - eye;
  if (!(glm::length(forward) > 0)) refuse(node.where, path + " has the same eye and target, expected different points");
  if (!(glm::length(glm::cross(glm::normalize(forward), up)) > 1e-6f * glm::length(up))) {
    refuse(node.where, path + " has an up that is zero or along the view, expected another direction");
  }
  camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, up));
  return camera;
}

Sun read_sun(const JsonNode& node) {
  Members members(node, "sun");
  Sun sun;
  const JsonNode& direction = members.require("direction");
  const glm::vec3 given = members.vec3(direction, "direction", -Members::kLargest);
  if (!(glm::length(given) > 0))
    refuse(direction.where, "sun.direction is zero, expected the direction the light travels in");
  sun.direction = glm::normalize(given);
  sun.irradiance = members.vec3(members.require("irradiance"), "irradiance", 0);
  sun.angular_radius = glm::radians(static_cast<float>(members.number_or("angular_radius_degrees", 0, 0, 89)));
  members.finish();
  return sun;
}

Environment read_environment(const JsonNode& node, const std::filesystem::path& folder) {
  Members members(node, "environment");
  Environment environment;
  const JsonNode* radiance = members.find("radiance");
  const JsonNode* image = members.find("image");
  const JsonNode* scale = members.find("scale");
  if ((radiance != nullptr) == (image != nullptr))
    refuse(node.where, "environment has " +
                           std::string(radiance ? "both radiance and image" : "neither radiance nor image") +
                           ", expected one of them");
  if (radiance) {
    if (scale) refuse(scale->where, "environment.scale belongs to an image, expected none beside radiance");
    environment.radiance = members.vec3(*radiance, "radiance", 0);
  } else {
    const std::string& file = members.typed(*image, "image", JsonKind::string).string;
    environment.radiance = glm::vec3(scale ? static_cast<float>(members.number(*scale, "scale", 0, 1e9)) : 1.0f);
    load_environment(folder / file, place(*image) + ": environment.image", environment);
  }
  members.finish();
  return environment;
}

JsonNode parse(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  std::optional<JsonNode> root = parse_json(read_text_file(path), path.string(), diagnostics);
  if (diagnostics.has_errors() || !root) {
    const Diagnostic first = diagnostics.sorted().front();
    refuse(first.where, first.message, first.hint);
  }
  return std::move(*root);
}

}  // namespace

SceneFile read_scene_file(const std::filesystem::path& path) {
  const JsonNode root = parse(path);
  const std::filesystem::path folder = path.parent_path();
  Members members(root, "");
  const JsonNode& version = members.require("lightloom_scene");
  if (members.typed(version, "lightloom_scene", JsonKind::integer).integer != 1) {
    refuse(version.where, "lightloom_scene is " + std::to_string(version.integer) + ", expected 1");
  }
  SceneFile result;
  const JsonNode& gltf = members.require("gltf");
  InstanceSpec main;
  main.gltf = folder / members.typed(gltf, "gltf", JsonKind::string).string;
  main.where = place(gltf) + ": gltf";
  result.instances.push_back(main);
  if (const JsonNode* instances = members.find("instances")) {
    members.typed(*instances, "instances", JsonKind::array);
    for (size_t i = 0; i < instances->elements.size(); ++i) {
      result.instances.push_back(read_instance(instances->elements[i], folder, "instances[" + std::to_string(i) + "]"));
    }
  }
  if (const JsonNode* cameras = members.find("cameras")) {
    for (const JsonMember& member : members.typed(*cameras, "cameras", JsonKind::object).members) {
      result.cameras.push_back(read_camera(member.value, member.key, "cameras." + member.key));
    }
  }
  if (const JsonNode* sun = members.find("sun")) result.sun = read_sun(*sun);
  if (const JsonNode* environment = members.find("environment"))
    result.environment = read_environment(*environment, folder);
  members.finish();
  return result;
}

}  // namespace lightloom::scene
