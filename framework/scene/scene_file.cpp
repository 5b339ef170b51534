#include "framework/scene/scene_file.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/images.hpp"
#include "framework/scene/json_members.hpp"
#include "framework/scene/scene_keys.hpp"

namespace lightloom::scene {
namespace {

glm::dvec3 point(const JsonMembers& members, const JsonNode& node, const std::string& key) {
  const std::vector<double> xyz = members.numbers(node, key, 3, -JsonMembers::kLargest);
  return {xyz[0], xyz[1], xyz[2]};
}

InstanceSpec read_instance(const JsonNode& node, const std::filesystem::path& folder, const std::string& path) {
  JsonMembers members(node, path);
  InstanceSpec instance;
  const JsonNode& gltf = members.require("gltf");
  instance.gltf = folder / members.typed(gltf, "gltf", JsonKind::string).string;
  instance.where = place_of(gltf) + ": " + path;
  if (const JsonNode* translation = members.find("translation"))
    instance.translation = point(members, *translation, "translation");
  instance.rotation_y = glm::radians(static_cast<float>(members.number_or("rotation_y_degrees", kInstanceRotation)));
  instance.scale = static_cast<float>(members.number_or("scale", kInstanceScale));
  instance.time_offset = members.number_or("time_offset_seconds", kTimeOffset);
  if (const JsonNode* animation = members.find("animation")) {
    instance.animation_named = true;
    if (animation->kind == JsonKind::integer && animation->integer >= 0 && animation->integer < kMostAnimations) {
      instance.animation = static_cast<int>(animation->integer);
    } else {
      instance.animation = members.typed(*animation, "animation", JsonKind::string).string;
    }
  }
  members.finish(kInstanceKeys);
  return instance;
}

CameraSpec read_camera(const JsonNode& node, const std::string& name, const std::string& path) {
  JsonMembers members(node, path);
  CameraSpec camera;
  camera.camera.name = name;
  camera.eye = point(members, members.require("eye"), "eye");
  camera.target = point(members, members.require("target"), "target");
  camera.up = members.vec3_or("up", {0, 1, 0}, -JsonMembers::kLargest);
  camera.camera.vertical_fov =
      glm::radians(static_cast<float>(members.number_or("vertical_fov_degrees", kFieldOfView)));
  members.finish(kCameraKeys);
  const glm::vec3 forward(camera.target - camera.eye);
  if (!(glm::length(forward) > 0))
    refuse_json(node.where, path + " has the same eye and target, expected different points");
  if (!(glm::length(glm::cross(glm::normalize(forward), camera.up)) > 1e-6f * glm::length(camera.up))) {
    refuse_json(node.where, path + " has an up that is zero or along the view, expected another direction");
  }
  return camera;
}

Sun read_sun(const JsonNode& node) {
  JsonMembers members(node, "sun");
  Sun sun;
  const JsonNode& direction = members.require("direction");
  const glm::vec3 given = members.vec3(direction, "direction", -JsonMembers::kLargest);
  if (!(glm::length(given) > 0))
    refuse_json(direction.where, "sun.direction is zero, expected the direction the light travels in");
  sun.direction = glm::normalize(given);
  sun.irradiance = members.vec3(members.require("irradiance"), "irradiance", 0);
  sun.angular_radius = glm::radians(static_cast<float>(members.number_or("angular_radius_degrees", kSunRadius)));
  members.finish(kSunKeys);
  return sun;
}

Environment read_environment(const JsonNode& node, const std::filesystem::path& folder, const LoadOptions& options) {
  JsonMembers members(node, "environment");
  Environment environment;
  const JsonNode* radiance = members.find("radiance");
  const JsonNode* image = members.find("image");
  const JsonNode* scale = members.find("scale");
  if ((radiance != nullptr) == (image != nullptr))
    refuse_json(node.where, "environment has " +
                                std::string(radiance ? "both radiance and image" : "neither radiance nor image") +
                                ", expected one of them");
  if (radiance) {
    if (scale) refuse_json(scale->where, "environment.scale belongs to an image, expected none beside radiance");
    environment.radiance = members.vec3(*radiance, "radiance", 0);
  } else {
    const std::string& file = members.typed(*image, "image", JsonKind::string).string;
    environment.radiance = glm::vec3(scale ? static_cast<float>(members.number(
                                                 *scale, "scale", kEnvironmentScale.minimum, kEnvironmentScale.maximum))
                                           : 1.0f);
    load_environment(folder / file, place_of(*image) + ": environment.image", environment, options);
  }
  members.finish(kEnvironmentKeys);
  return environment;
}

}  // namespace

glm::mat4 look_at_target(const CameraSpec& camera, const glm::dvec3& origin) {
  const glm::vec3 eye(camera.eye - origin), target(camera.target - origin), forward(camera.target - camera.eye);
  const bool resolved = glm::distance(target - eye, forward) <= 1e-3f * glm::length(forward);
  if (resolved) return glm::inverse(glm::lookAt(eye, target, camera.up));
  // A camera so far off that floats do not tell eye and target apart still looks where it is told to.
  glm::mat4 matrix = glm::inverse(glm::lookAt(glm::vec3(0), forward, camera.up));
  matrix[3] = glm::vec4(eye, 1);
  return matrix;
}

SceneFile read_scene_file(const std::filesystem::path& path, const LoadOptions& options) {
  const JsonNode root = parse_json_file(path, options.limits);
  const std::filesystem::path folder = path.parent_path();
  JsonMembers members(root, "the scene file", "");
  if (const JsonNode* schema = members.find("$schema")) members.typed(*schema, "$schema", JsonKind::string);
  const JsonNode& version = members.require("lightloom_scene");
  if (members.typed(version, "lightloom_scene", JsonKind::integer).integer != kSceneFormatVersion) {
    refuse_json(version.where, "lightloom_scene is " + std::to_string(version.integer) + ", expected 1");
  }
  SceneFile result;
  const JsonNode& gltf = members.require("gltf");
  InstanceSpec main;
  main.gltf = folder / members.typed(gltf, "gltf", JsonKind::string).string;
  main.where = place_of(gltf) + ": gltf";
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
    result.environment = read_environment(*environment, folder, options);
  members.finish(kSceneKeys);
  return result;
}

}  // namespace lightloom::scene
