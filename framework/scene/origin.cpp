#include "framework/scene/origin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace lightloom::scene {
namespace {

constexpr double kLeastSnaps = 8;      ///< nearer to the world's origin a scene keeps its coordinates
constexpr double kNoise = 1e-6;        ///< of a length: what composing transforms far off may add to it
constexpr double kMostDistant = 1e15;  ///< farther coordinates are refused elsewhere
constexpr float kWastedRatio = 32;

template <typename Vector>
struct Box {
  using Number = typename Vector::value_type;
  Vector min{std::numeric_limits<Number>::infinity()};
  Vector max{-std::numeric_limits<Number>::infinity()};
  void add(const Vector& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  [[nodiscard]] Number longest() const {
    const Vector size = max - min;
    return std::max({size.x, size.y, size.z});
  }
};

using WorldBox = Box<glm::dvec3>;

WorldBox box_of(const Primitive& primitive) {
  WorldBox box;
  for (const uint32_t vertex : primitive.indices) box.add(glm::dvec3(primitive.vertices[vertex].position));
  return box;
}

void add_box(const glm::dmat4& world, const WorldBox& box, WorldBox& all) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                           (corner & 4) != 0 ? box.max.z : box.min.z);
    all.add(glm::dvec3(world * glm::dvec4(point, 1)));
  }
}

/// Holds all that the draws draw; what skins deform lies within the boxes of all its joints.
WorldBox box_of(const SceneSource& source, std::span<const Draw> draws) {
  const std::vector<glm::dmat4> world = world_from_nodes(source);
  std::map<const Primitive*, WorldBox> boxes;
  WorldBox all;
  for (const Draw& draw : draws) {
    const Primitive& primitive = *draw.primitive;
    const auto [found, is_new] = boxes.try_emplace(&primitive);
    if (is_new) found->second = box_of(primitive);
    if (draw.skin < 0 || primitive.influences.empty()) {
      add_box(world[static_cast<size_t>(draw.node)], found->second, all);
      continue;
    }
    const SourceSkin& skin = source.skins[static_cast<size_t>(draw.skin)];
    for (size_t j = 0; j < std::min<size_t>(skin.joints.size(), primitive.joint_limit); ++j)
      add_box(world[static_cast<size_t>(skin.joints[j])] * glm::dmat4(skin.inverse_bind[j]), found->second, all);
  }
  return all;
}

}  // namespace

glm::dvec3 choose_origin(const SceneSource& source, std::span<const Draw> draws) {
  const WorldBox box = box_of(source, draws);
  const glm::dvec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double size = box.longest();
  if (!(std::max({reach.x, reach.y, reach.z}) <= kMostDistant) || !(size > 0)) return glm::dvec3(0);
  const double snap = std::exp2(std::ceil(std::log2(size * (1 - kNoise))));
  // Halves go down, also where noise has made them more, so that a scene from 0 to `snap` is one that lies at 0.
  const glm::dvec3 steps = glm::ceil(0.5 * (box.min + box.max) / snap - 0.5 - kNoise);
  const glm::dvec3 away = glm::abs(steps);
  if (std::max({away.x, away.y, away.z}) < kLeastSnaps) return glm::dvec3(0);
  return steps * snap;
}

std::string far_outlier_warning(const Scene& scene) {
  const size_t count = scene.triangles.size();
  if (count < 3) return {};
  std::vector<glm::vec3> centres;
  centres.reserve(count);
  const auto corner = [&](uint32_t vertex) { return scene.vertices[vertex].position; };
  for (const Triangle& t : scene.triangles) centres.push_back((corner(t.a) + corner(t.b) + corner(t.c)) / 3.0f);
  glm::vec3 middle(0);
  std::vector<float> along(count);
  for (int axis = 0; axis < 3; ++axis) {
    for (size_t i = 0; i < count; ++i) along[i] = centres[i][axis];
    const auto half = along.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(along.begin(), half, along.end());
    middle[axis] = *half;
  }
  std::vector<size_t> order(count);
  for (size_t i = 0; i < count; ++i) order[i] = i;
  const size_t outliers = std::max<size_t>(1, count / 100);
  const auto first_outlier = order.begin() + static_cast<std::ptrdiff_t>(count - outliers);
  std::nth_element(order.begin(), first_outlier, order.end(), [&](size_t a, size_t b) {
    return glm::distance(centres[a], middle) < glm::distance(centres[b], middle);
  });
  Box<glm::vec3> inner;
  for (auto it = order.begin(); it != first_outlier; ++it) {
    const Triangle& t = scene.triangles[*it];
    for (const uint32_t vertex : {t.a, t.b, t.c}) inner.add(corner(vertex));
  }
  const glm::vec3 whole = scene.bounds.max - scene.bounds.min;
  const float longest = std::max({whole.x, whole.y, whole.z});
  if (inner.longest() * kWastedRatio >= longest) return {};
  std::ostringstream text;
  text.precision(3);
  text << "all but " << outliers << " of the " << count << " triangles lie within " << inner.longest()
       << " m, but the scene is " << longest
       << " m long: a voxel grid over all of it has few voxels where they are; is something misplaced?";
  return text.str();
}

}  // namespace lightloom::scene
