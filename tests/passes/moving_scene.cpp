#include "tests/passes/moving_scene.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "tests/support/graph_runner.hpp"

namespace lightloom::test {
namespace {

using nlohmann::json;
using scene::test::GltfBuilder;

constexpr double kFramesPerSecond = 30;
constexpr double kEnd = kAnimationFrames / kFramesPerSecond;

/// Frames and the values that hold from them on.
using Keys = std::vector<std::pair<uint32_t, glm::dvec3>>;

/// Builds the glTF file: the wall, and whatever the caller adds to it.
class Stage {
 public:
  Stage() {
    builder.node({{"name", "wall"}, {"mesh", builder.quad()}, {"translation", {-4, -4, -1}}, {"scale", {8, 8, 1}}});
  }

  /// `values`: of the two keys at frame 0 and kAnimationFrames, unless `times` says otherwise [s].
  void animate(int node, const std::string& path, const std::vector<float>& values,
               const std::vector<float>& times = {0, static_cast<float>(kEnd)},
               const std::string& interpolation = "LINEAR") {
    const std::string type = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
    const int input = builder.accessor(times, "SCALAR"), output = builder.accessor(values, type);
    const size_t sampler = samplers.size();
    samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    channels.push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  /// A value that jumps between two frames: keys lie in the middle, away from rounding.
  void jump(int node, const std::string& path, const Keys& keys) {
    std::vector<float> times, values;
    for (const auto& [frame, value] : keys) {
      times.push_back(frame == 0 ? 0.0f : static_cast<float>((frame - 0.5) / kFramesPerSecond));
      for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(value[axis]));
    }
    times.push_back(static_cast<float>(kEnd));
    values.insert(values.end(), values.end() - 3, values.end());
    animate(node, path, values, times, "STEP");
  }

  void translate(int node, const glm::dvec3& start, const glm::dvec3& step) {
    const glm::vec3 from(start), to(start + step * double{kAnimationFrames});
    animate(node, "translation", {from.x, from.y, from.z, to.x, to.y, to.z});
  }

  /// Keys a frame apart, between which linear and spherical interpolation are the same to the last digits.
  void rotate(int node, const glm::dvec3& axis, double angle) {
    std::vector<float> times, values;
    for (uint32_t frame = 0; frame <= kAnimationFrames; ++frame) {
      const glm::quat turn(glm::angleAxis(angle * frame, glm::normalize(axis)));
      times.push_back(static_cast<float>(frame / kFramesPerSecond));
      values.insert(values.end(), {turn.x, turn.y, turn.z, turn.w});
    }
    animate(node, "rotation", values, times);
  }

  /// A square around the origin of its node, facing +z.
  int centred_square(double size) {
    const auto h = static_cast<float>(size / 2);
    const int positions = builder.accessor<float>({-h, -h, 0, h, -h, 0, h, h, 0, -h, h, 0}, "VEC3");
    const int normals = builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int indices = builder.accessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    return builder.mesh({{"POSITION", positions}, {"NORMAL", normals}}, indices);
  }

  int mover(int mesh) { return builder.node({{"name", "mover"}, {"mesh", mesh}}); }

  int camera_node() {
    builder.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    return builder.node({{"name", "camera"}, {"camera", 0}, {"translation", {0, 0, 3}}});
  }

  /// Everything is Lambertian and seen from both sides. Without a camera node: the front view.
  scene::Scene load() {
    if (!channels.empty()) builder.json["animations"] = {{{"samplers", samplers}, {"channels", channels}}};
    scene::Scene loaded = builder.load();
    for (scene::Material& material : loaded.materials) material = white_lambertian();
    if (!builder.json.contains("cameras")) loaded.cameras = {look_at({0, 0, 3}, {0, 0, 0}, 0.8f)};
    return loaded;
  }

  GltfBuilder builder;

 private:
  json samplers = json::array(), channels = json::array();
};

HostCamera still_camera(uint32_t /*frame*/) {
  return front_view();
}

glm::dvec3 unmoved(const glm::dvec3& now, uint32_t /*frame*/, uint32_t /*earlier*/) {
  return now;
}

/// Points at height y of [-0.5, 0.5] move by (y + 0.5) times `step` a frame; `step` has no y.
Follow sheared(const glm::dvec3& step) {
  return [step](const glm::dvec3& now, uint32_t frame, uint32_t earlier) {
    return now - (now.y + 0.5) * (double{1} * frame - earlier) * step;
  };
}

/// Linear in time, as translations.
void drive(Stage& stage, int node, const glm::dvec3& step) {
  stage.translate(node, {0, 0, 0}, step);
}

}  // namespace

std::optional<glm::dvec2> HostCamera::project(const glm::dvec3& point, uint32_t width, uint32_t height) const {
  const glm::dvec3 offset = point - eye;
  const double depth = -glm::dot(offset, back);
  if (depth <= 0) return std::nullopt;
  const double scale = height / (2 * std::tan(vertical_fov / 2) * depth);  // [pixels / m]
  return glm::dvec2(width / 2.0 + glm::dot(offset, right) * scale, height / 2.0 - glm::dot(offset, up) * scale);
}

glm::dvec3 HostCamera::ray(const glm::dvec2& pixel, uint32_t width, uint32_t height) const {
  const double half = std::tan(vertical_fov / 2);
  return right * ((2 * pixel.x - width) / height * half) + up * ((1 - 2 * pixel.y / height) * half) - back;
}

HostCamera front_view() {
  HostCamera camera;
  camera.eye = {0, 0, 3};
  return camera;
}

glm::dvec3 MovingScene::follow(uint32_t object, const glm::dvec3& now, uint32_t frame, uint32_t earlier) const {
  return object == 0 ? now : mover(now, frame, earlier);
}

MovingScene translating_scene(const glm::dvec3& start, const glm::dvec3& step, double size) {
  Stage stage;
  stage.translate(stage.mover(stage.centred_square(size)), start, step);
  return {stage.load(), still_camera, [step](const glm::dvec3& now, uint32_t frame, uint32_t earlier) {
            return now - (double{1} * frame - earlier) * step;
          }};
}

MovingScene rotating_scene(const glm::dvec3& axis, double angle, double size) {
  Stage stage;
  stage.rotate(stage.mover(stage.centred_square(size)), axis, angle);
  return {stage.load(), still_camera, [axis, angle](const glm::dvec3& now, uint32_t frame, uint32_t earlier) {
            return glm::angleAxis(angle * (double{1} * earlier - frame), glm::normalize(axis)) * now;
          }};
}

MovingScene skinned_scene(const glm::dvec3& step) {
  Stage stage;
  const int mesh = stage.centred_square(1);
  const int joints = stage.builder.accessor<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  const int weights = stage.builder.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  json& attributes = stage.builder.json["meshes"][static_cast<size_t>(mesh)]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  const int mover = stage.mover(mesh);
  const int lower = stage.builder.node({{"name", "lower"}}), upper = stage.builder.node({{"name", "upper"}});
  stage.builder.append("skins", {{"joints", {lower, upper}}});
  stage.builder.json["nodes"][static_cast<size_t>(mover)]["skin"] = 0;
  drive(stage, upper, step);
  return {stage.load(), still_camera, sheared(step)};
}

MovingScene morphed_scene(const glm::dvec3& step) {
  Stage stage;
  const int mesh = stage.centred_square(1);
  const glm::vec3 far(step * double{kAnimationFrames});
  const int target =
      stage.builder.accessor<float>({0, 0, 0, 0, 0, 0, far.x, far.y, far.z, far.x, far.y, far.z}, "VEC3");
  stage.builder.json["meshes"][static_cast<size_t>(mesh)]["primitives"][0]["targets"] = {{{"POSITION", target}}};
  stage.animate(stage.mover(mesh), "weights", {0, 1});
  return {stage.load(), still_camera, sheared(step)};
}

MovingScene jumping_scene(const glm::dvec3& before, const glm::dvec3& after, uint32_t change) {
  Stage stage;
  stage.jump(stage.mover(stage.centred_square(0.8)), "translation", {{0, before}, {change, after}});
  const auto place = [=](uint32_t frame) { return frame < change ? before : after; };
  return {stage.load(), still_camera, [place](const glm::dvec3& now, uint32_t frame, uint32_t earlier) {
            return now - place(frame) + place(earlier);
          }};
}

MovingScene flickering_scene(uint32_t appear, uint32_t vanish) {
  Stage stage;
  stage.jump(stage.mover(stage.centred_square(0.8)), "scale",
             appear == 0 ? Keys{{0, glm::dvec3(1)}, {vanish, glm::dvec3(0)}}
                         : Keys{{0, glm::dvec3(0)}, {appear, glm::dvec3(1)}, {vanish, glm::dvec3(0)}});
  return {stage.load(), still_camera, unmoved};
}

MovingScene dolly_scene(const glm::dvec3& step, double angle) {
  Stage stage;
  stage.mover(stage.centred_square(1));
  const int camera = stage.camera_node();
  stage.translate(camera, {0, 0, 3}, step);
  stage.rotate(camera, {0, 1, 0}, angle);
  return {stage.load(),
          [=](uint32_t frame) {
            HostCamera view = front_view();
            view.eye += step * double{1} * double(frame);
            view.right = {std::cos(angle * frame), 0, -std::sin(angle * frame)};
            view.back = {std::sin(angle * frame), 0, std::cos(angle * frame)};
            return view;
          },
          unmoved};
}

MovingScene cut_scene(const glm::dvec3& offset, uint32_t cut) {
  Stage stage;
  stage.mover(stage.centred_square(1));
  stage.jump(stage.camera_node(), "translation", {{0, {0, 0, 3}}, {cut, glm::dvec3(0, 0, 3) + offset}});
  return {stage.load(),
          [=](uint32_t frame) {
            HostCamera view = front_view();
            if (frame >= cut) view.eye += offset;
            return view;
          },
          unmoved};
}

}  // namespace lightloom::test
