#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "framework/scene/basis.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/finish.hpp"

namespace lightloom::scene {
namespace {

constexpr double kSampleRate = 30;     ///< [Hz]
constexpr double kVertexBudget = 6e7;  ///< posed vertices over all samples of a clip
constexpr double kMinSamples = 64;
constexpr double kMaxSamples = 65536;
constexpr float kDynamicPadding = 0.02f;  ///< of the diagonal of what moves

struct Box {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};
  void add(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
};

// Scene times at which a clip is looked at; each clip repeats, so one of its periods suffices for what it moves.
std::set<double> sample_times(const Clip& clip, size_t vertices) {
  const double affordable =
      std::clamp(kVertexBudget / static_cast<double>(std::max<size_t>(vertices, 1)), kMinSamples, kMaxSamples);
  const double wanted = std::min(affordable, std::ceil(clip.duration * kSampleRate) + 1);
  std::set<double> times;
  for (double i = 0; i < wanted; ++i) times.insert(clip.duration * i / wanted);
  times.insert(clip.duration * (1 - 1e-9));
  for (const Track& track : clip.tracks) {
    for (const float key : track.times) {
      if (static_cast<double>(times.size()) > affordable + 1) break;
      if (static_cast<double>(key) < clip.duration) times.insert(static_cast<double>(key));
    }
  }
  return times;
}

size_t vertex_count(const SceneSource& source) {
  return std::accumulate(source.draws.begin(), source.draws.end(), size_t{0},
                         [](size_t sum, const Draw& draw) { return sum + draw.primitive->vertices.size(); });
}

void add_poses(const SceneSource& part, const std::set<double>& times, std::vector<Box>& boxes) {
  const size_t first = boxes.size();
  boxes.resize(first + part.draws.size());
  std::vector<Vertex> posed;
  for (const double time : times) {
    const NodeState state = evaluate_nodes(part, time - part.clips.front().offset);
    for (size_t d = 0; d < part.draws.size(); ++d) {
      const Draw& draw = part.draws[d];
      posed.resize(draw.primitive->vertices.size());
      pose_vertices(part, draw, state, posed);
      for (const Vertex& vertex : posed) boxes[first + d].add(vertex.position);
    }
  }
}

// A clip moves nodes of one instance only, so instances are looked at one by one, each for itself.
Box bounds_of_moving(const Scene& scene, const Limits& limits) {
  const size_t vertices = scene.vertices.size() - scene.static_vertex_count;
  std::vector<Box> boxes;
  uint64_t posed = 0;
  for (const Clip& clip : scene.source->clips) {
    const SceneSource part = part_of_clip(*scene.source, clip);
    const std::set<double> times = sample_times(clip, vertices);
    posed += times.size() * (vertex_count(part) + part.nodes.size());
    require_within(limits, &Limits::posed_elements, scene.file.string() + ": the animation", posed);
    add_poses(part, times, boxes);
  }
  Box all;
  for (const Box& box : boxes) {
    if (box.empty()) continue;
    const glm::vec3 padding(glm::length(box.max - box.min) * kDynamicPadding);
    all.add(box.min - padding);
    all.add(box.max + padding);
  }
  return all;
}

}  // namespace

Bounds find_bounds(const Scene& scene, const Limits& limits) {
  Box box;
  for (const Triangle& triangle : scene.triangles) {
    for (const uint32_t corner : {triangle.a, triangle.b, triangle.c}) box.add(scene.vertices[corner].position);
  }
  if (scene.static_triangle_count < scene.triangles.size()) {
    const Box moving = bounds_of_moving(scene, limits);
    box.add(moving.min);
    box.add(moving.max);
  }
  const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const float farthest = std::max({reach.x, reach.y, reach.z});
  if (!(farthest <= 1e15f))
    fail(scene.file.string(), "the animation",
         "moves vertices farther than 1e15 from the origin, expected a smaller scene");
  const glm::vec3 extent = box.max - box.min;
  const float thinnest = std::max({std::max({extent.x, extent.y, extent.z}) * 1e-3f, farthest * 1e-6f, 1e-12f});
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] >= thinnest) continue;
    box.min[axis] -= thinnest * 0.5f;
    box.max[axis] += thinnest * 0.5f;
  }
  return {box.min, box.max};
}

Camera framing_camera(const Bounds& bounds) {
  const glm::vec3 centre = (bounds.min + bounds.max) * 0.5f;
  const float radius = glm::length(bounds.max - bounds.min) * 0.5f;
  Camera camera;
  camera.name = "default";
  const glm::vec3 z = glm::normalize(glm::vec3(0.45f, 0.35f, 1.0f));
  const glm::vec3 y = orthonormal_tangent(z, {0, 1, 0});
  const glm::vec3 eye = centre + z * (radius / std::sin(camera.vertical_fov * 0.5f));
  camera.world_from_camera =
      glm::mat4(glm::vec4(glm::cross(y, z), 0), glm::vec4(y, 0), glm::vec4(z, 0), glm::vec4(eye, 1));
  return camera;
}

}  // namespace lightloom::scene
