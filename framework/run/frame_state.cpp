#include "framework/run/frame_state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "framework/base/error.hpp"

namespace lightloom::run {
namespace {

/// Near to far ratio: with 32-bit float depth and standard (not reversed) z it still resolves 1e-3 of the far distance
/// at the far plane.
constexpr float kNearToFar = 1e-4f;

float farthest_corner(const glm::mat4& camera_from_world, const scene::Bounds& bounds) {
  float farthest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 world((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                          (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                          (corner & 4) != 0 ? bounds.max.z : bounds.min.z);
    farthest = std::max(farthest, std::abs((camera_from_world * glm::vec4(world, 1)).z));
  }
  return farthest;
}

}  // namespace

View view_of(const scene::Camera& camera, const Extent3& extent, const scene::Bounds& bounds) {
  const glm::mat4 camera_from_world = glm::inverse(camera.world_from_camera);
  const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
  const float far_plane = farthest_corner(camera_from_world, bounds) * 1.01f;
  glm::mat4 clip_from_camera;
  View view;
  if (camera.perspective) {
    clip_from_camera = glm::perspectiveRH_ZO(camera.vertical_fov, aspect, far_plane * kNearToFar, far_plane);
    view.eye = glm::vec4(glm::vec3(camera.world_from_camera[3]), 1);
  } else {
    const float half_width = camera.half_height * aspect;
    clip_from_camera =
        glm::orthoRH_ZO(-half_width, half_width, -camera.half_height, camera.half_height, -far_plane, far_plane);
    view.eye = glm::vec4(glm::normalize(glm::vec3(camera.world_from_camera[2])), 0);
  }
  clip_from_camera[1] = -clip_from_camera[1];
  view.view_projection = clip_from_camera * camera_from_world;
  return view;
}

FrameBlock make_frame_block(const scene::Scene& scene, const FrameInputs& inputs) {
  FrameBlock block{};
  for (uint32_t age = 0; age < kHistoryLimit; ++age) {
    const View& view = inputs.views.at(std::min<size_t>(age, inputs.views.size() - 1));
    block.view_projection[age] = view.view_projection;
    block.eye[age] = view.eye;
  }
  block.inverse_view_projection = glm::mat4(glm::inverse(glm::dmat4(block.view_projection[0])));
  block.ids = glm::uvec4(inputs.frame, inputs.seed, inputs.history_length, 0);
  block.scene_min = glm::vec4(scene.bounds.min, 0);
  block.scene_max = glm::vec4(scene.bounds.max, 0);
  if (scene.sun) {
    // 1 - cosine without the cancellation that would leave two digits of it for the real sun.
    const double half_sine = std::sin(0.5 * static_cast<double>(scene.sun->angular_radius));
    block.sun_direction = glm::vec4(scene.sun->direction, 0);
    block.sun_irradiance = glm::vec4(scene.sun->irradiance, 2 * half_sine * half_sine);
  }
  block.environment = glm::vec4(scene.environment.radiance, scene.environment.rgb.empty() ? 0 : 1);
  const auto triangles = static_cast<uint32_t>(scene.triangles.size());
  block.counts = glm::uvec4(scene.static_triangle_count, triangles - scene.static_triangle_count, inputs.hint_count,
                            static_cast<uint32_t>(scene.punctual.size()));
  block.motion =
      glm::uvec4(scene.static_vertex_count, static_cast<uint32_t>(scene.vertices.size()) - scene.static_vertex_count,
                 inputs.newest_slot, static_cast<uint32_t>(std::min<size_t>(inputs.views.size(), kHistoryLimit)));
  return block;
}

std::vector<PunctualEntry> make_punctual_entries(const std::vector<scene::PunctualLight>& lights) {
  if (lights.size() > kPunctualLimit)
    throw Error(ExitCode::invalid_input, "the scene has " + std::to_string(lights.size()) +
                                             " punctual lights, more than the " + std::to_string(kPunctualLimit) +
                                             " that a frame holds");
  std::vector<PunctualEntry> entries;
  for (const scene::PunctualLight& light : lights) {
    PunctualEntry entry{};
    entry.position = glm::vec4(light.position, light.range);
    entry.direction = glm::vec4(light.direction, static_cast<float>(light.type));
    entry.intensity = glm::vec4(light.intensity, 0);
    const float inner = std::cos(light.inner_cone);
    const float outer = std::cos(light.outer_cone);
    const float scale = 1.0f / std::max(0.001f, inner - outer);
    entry.cone = glm::vec4(scale, -outer * scale, 0, 0);
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace lightloom::run
