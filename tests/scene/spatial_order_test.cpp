#include "framework/scene/spatial_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <span>

namespace lightloom::scene {
namespace {

/// `count` small triangles at random places.
Scene scattered(size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-5, 5);
  Scene scene;
  for (uint32_t t = 0; t < count; ++t) {
    const glm::vec3 at(place(random), 0.3f * place(random), place(random));
    for (const glm::vec3& step : {glm::vec3(0), glm::vec3(0.1f, 0, 0), glm::vec3(0, 0.1f, 0)}) {
      Vertex vertex;
      vertex.position = at + step;
      scene.vertices.push_back(vertex);
    }
    scene.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2, 0, 0});
  }
  return scene;
}

std::vector<uint32_t> every_triangle(const Scene& scene) {
  std::vector<uint32_t> list(scene.triangles.size());
  std::iota(list.begin(), list.end(), 0u);
  return list;
}

/// Is there an axis that parts the first half, and so on down to single triangles?
bool halves_are_apart(const Scene& scene, std::span<const uint32_t> list) {
  if (list.size() < 3) return true;
  const size_t half = (list.size() + 1) / 2;
  const auto part = [&](std::span<const uint32_t> some, int axis) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const uint32_t t : some) {
      low = std::min(low, scene.vertices[scene.triangles[t].a].position[axis]);
      high = std::max(high, scene.vertices[scene.triangles[t].a].position[axis]);
    }
    return std::pair(low, high);
  };
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
    apart = apart || part(list.first(half), axis).second <= part(list.subspan(half), axis).first + 1e-5f;
  return apart && halves_are_apart(scene, list.first(half)) && halves_are_apart(scene, list.subspan(half));
}

TEST(SpatialOrder, EachHalfLiesOnOneSide) {
  for (const size_t count : {0u, 1u, 2u, 3u, 5u, 64u, 1001u}) {
    const Scene scene = scattered(count);
    std::vector<uint32_t> list = every_triangle(scene);
    if (count > 20) {
      EXPECT_FALSE(halves_are_apart(scene, list)) << "the test would see nothing";
    }
    order_in_space(scene, list);
    EXPECT_TRUE(halves_are_apart(scene, list)) << count;
    std::sort(list.begin(), list.end());
    EXPECT_EQ(list, every_triangle(scene)) << "each once";
  }
}

TEST(SpatialOrder, PlacesThatAreNoNumbersDoNoHarm) {
  Scene scene = scattered(50);
  for (size_t v = 0; v < scene.vertices.size(); v += 9)
    scene.vertices[v].position.x = std::numeric_limits<float>::quiet_NaN();
  scene.vertices[30].position.y = std::numeric_limits<float>::infinity();
  std::vector<uint32_t> list = every_triangle(scene);
  order_in_space(scene, list);
  std::sort(list.begin(), list.end());
  EXPECT_EQ(list, every_triangle(scene));
}

}  // namespace
}  // namespace lightloom::scene
