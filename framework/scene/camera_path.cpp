#include "framework/scene/camera_path.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/basis.hpp"
#include "framework/scene/json_members.hpp"

namespace lightloom::scene {
namespace {

constexpr double kLeastFov = 0.01;  ///< [degrees]
constexpr double kMostFov = 179.9;

glm::dvec3 point(const JsonMembers& members, const JsonNode& node, const std::string& key) {
  const std::vector<double> xyz = members.numbers(node, key, 3, -JsonMembers::kLargest);
  return {xyz[0], xyz[1], xyz[2]};
}

glm::dquat rotation(const JsonMembers& members, const JsonNode& node, const std::string& path) {
  const std::vector<double> xyzw = members.numbers(node, "rotation", 4, -JsonMembers::kLargest);
  const glm::dquat quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (!(std::abs(glm::length(quaternion) - 1) < 1e-2))
    refuse_json(node.where, path + ".rotation is not of length 1, expected a unit quaternion x, y, z, w");
  return glm::normalize(quaternion);
}

CameraKey read_key(const JsonNode& node, const std::string& path, const glm::dvec3& up) {
  JsonMembers members(node, path);
  CameraKey key;
  key.time = members.number(members.require("time"), "time", -JsonMembers::kLargest, JsonMembers::kLargest);
  key.position = point(members, members.require("position"), "position");
  const JsonNode* target = members.find("target");
  const JsonNode* turn = members.find("rotation");
  if ((target != nullptr) == (turn != nullptr))
    refuse_json(node.where, path + " has " + (target ? "both target and rotation" : "neither target nor rotation") +
                                ", expected one of them");
  if (target) {
    const glm::dvec3 aim = point(members, *target, "target");
    const glm::dvec3 forward = aim - key.position;
    if (!(glm::length(forward) > 0))
      refuse_json(target->where, path + " has the same position and target, expected different points");
    if (!(glm::length(glm::cross(glm::normalize(forward), up)) > 1e-6 * glm::length(up)))
      refuse_json(target->where, path + " looks along up, expected another direction");
    key.aim = aim;
  } else {
    key.aim = rotation(members, *turn, path);
  }
  if (const JsonNode* fov = members.find("vertical_fov_degrees"))
    key.vertical_fov = glm::radians(members.number(*fov, "vertical_fov_degrees", kLeastFov, kMostFov));
  members.finish();
  return key;
}

PathInterpolation read_interpolation(const JsonMembers& members, const JsonNode& node) {
  const std::string& name = members.typed(node, "interpolation", JsonKind::string).string;
  for (const PathInterpolation known : {PathInterpolation::linear, PathInterpolation::catmull_rom})
    if (name == to_string(known)) return known;
  refuse_json(node.where, "interpolation is '" + name + "', expected 'linear' or 'catmull_rom'");
}

void check_sequence(const std::vector<CameraKey>& keys, const JsonNode& nodes) {
  for (size_t i = 1; i < keys.size(); ++i) {
    const JsonNode& node = nodes.elements[i];
    const std::string path = "keyframes[" + std::to_string(i) + "]";
    if (!(keys[i].time > keys[i - 1].time))
      refuse_json(node.where, path + " is not later than the one before, expected ascending times");
    if (keys[i].aim.index() != keys[0].aim.index())
      refuse_json(node.where, path + " has a " + (keys[i].aim.index() == 0 ? "target" : "rotation") +
                                  " unlike the first, expected targets in all or rotations in all");
    if (keys[i].vertical_fov.has_value() != keys[0].vertical_fov.has_value())
      refuse_json(node.where, path + (keys[i].vertical_fov ? " has a" : " has no") +
                                  " vertical_fov_degrees unlike the first, expected it in all or in none");
  }
}

/// Slope at keyframe `i` of the parabola through its neighbours, per second; `value(k)` is what keyframe k has.
template <typename Value>
auto slope(const std::vector<CameraKey>& keys, size_t i, const Value& value) -> decltype(value(0)) {
  const auto chord = [&](size_t from) {
    return (value(from + 1) - value(from)) / (keys[from + 1].time - keys[from].time);
  };
  if (i == 0) return chord(0);
  if (i + 1 == keys.size()) return chord(i - 1);
  const double before = keys[i].time - keys[i - 1].time;
  const double after = keys[i + 1].time - keys[i].time;
  return (chord(i - 1) * after + chord(i) * before) / (before + after);
}

/// Between keyframe `i` and the next; `amount` in [0, 1].
template <typename Value>
auto between(const CameraPath& path, size_t i, double amount, const Value& value) -> decltype(value(0)) {
  const auto from = value(i), to = value(i + 1);
  if (path.interpolation == PathInterpolation::linear) return from + (to - from) * amount;
  const double seconds = path.keys[i + 1].time - path.keys[i].time;
  const double t = amount, t2 = t * t, t3 = t2 * t;
  return from * (2 * t3 - 3 * t2 + 1) + slope(path.keys, i, value) * ((t3 - 2 * t2 + t) * seconds) +
         to * (3 * t2 - 2 * t3) + slope(path.keys, i + 1, value) * ((t3 - t2) * seconds);
}

glm::dmat4 look(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up) {
  // A curve may bring position and target together, or the view onto `up`, where nothing says how to look.
  const glm::vec3 z = unit_or(glm::vec3(position - target), {0, 0, 1});
  const glm::vec3 y = orthonormal_tangent(z, glm::vec3(up));
  return {glm::dvec4(glm::cross(y, z), 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
}

}  // namespace

std::string to_string(PathInterpolation interpolation) {
  return interpolation == PathInterpolation::linear ? "linear" : "catmull_rom";
}

CameraPath read_camera_path(const std::filesystem::path& path, const Limits& limits) {
  const JsonNode root = parse_json_file(path, limits);
  JsonMembers members(root, "the camera path", "");
  CameraPath result;
  result.file = path;
  const JsonNode& version = members.require("lightloom_camera_path");
  if (members.typed(version, "lightloom_camera_path", JsonKind::integer).integer != 1)
    refuse_json(version.where, "lightloom_camera_path is " + std::to_string(version.integer) + ", expected 1");
  if (const JsonNode* interpolation = members.find("interpolation"))
    result.interpolation = read_interpolation(members, *interpolation);
  if (const JsonNode* up = members.find("up")) {
    result.up = point(members, *up, "up");
    if (!(glm::length(result.up) > 0)) refuse_json(up->where, "up is zero, expected a direction");
  }
  const JsonNode& keyframes = members.require("keyframes");
  members.typed(keyframes, "keyframes", JsonKind::array);
  members.finish();
  if (keyframes.elements.empty()) refuse_json(keyframes.where, "keyframes is empty, expected at least one");
  for (size_t i = 0; i < keyframes.elements.size(); ++i)
    result.keys.push_back(read_key(keyframes.elements[i], "keyframes[" + std::to_string(i) + "]", result.up));
  check_sequence(result.keys, keyframes);
  return result;
}

Camera camera_on_path(const CameraPath& path, double time, Camera camera, const glm::dvec3& origin) {
  const std::vector<CameraKey>& keys = path.keys;
  size_t i = 0;
  while (i + 2 < keys.size() && time >= keys[i + 1].time) ++i;
  // With one keyframe the path has no segment; it is one from the keyframe to itself.
  const size_t next = std::min(i + 1, keys.size() - 1);
  const double seconds = keys[next].time - keys[i].time;
  const double amount = seconds > 0 ? std::clamp((time - keys[i].time) / seconds, 0.0, 1.0) : 0.0;
  const auto value_at = [&](const auto& value) { return next == i ? value(i) : between(path, i, amount, value); };

  const glm::dvec3 position = value_at([&](size_t k) { return keys[k].position; });
  if (keys[0].aim.index() == 0) {
    const glm::dvec3 target = value_at([&](size_t k) { return std::get<glm::dvec3>(keys[k].aim); });
    camera.world_from_camera = glm::mat4(look(position - origin, target - origin, path.up));
  } else {
    const glm::dquat turned =
        glm::slerp(std::get<glm::dquat>(keys[i].aim), std::get<glm::dquat>(keys[next].aim), amount);
    camera.world_from_camera = glm::mat4(glm::translate(glm::dmat4(1), position - origin) * glm::mat4_cast(turned));
  }
  if (keys[0].vertical_fov) {
    const double fov = value_at([&](size_t k) { return *keys[k].vertical_fov; });
    camera.vertical_fov = static_cast<float>(std::clamp(fov, glm::radians(kLeastFov), glm::radians(kMostFov)));
  }
  return camera;
}

}  // namespace lightloom::scene
