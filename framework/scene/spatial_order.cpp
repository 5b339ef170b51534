#include "framework/scene/spatial_order.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace lightloom::scene {
namespace {

struct Item {
  glm::vec3 center{0};  ///< three times the centre of the triangle [m]
  uint32_t triangle = 0;
};

/// The axis along which the centres spread most.
int longest_axis(std::span<const Item> items) {
  glm::vec3 low = items.front().center, high = low;
  for (const Item& item : items) {
    low = glm::min(low, item.center);
    high = glm::max(high, item.center);
  }
  const glm::vec3 extent = high - low;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

void split(std::span<Item> items) {
  while (items.size() > 2) {
    const int axis = longest_axis(items);
    const size_t first_half = (items.size() + 1) / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first_half), items.end(),
                     [axis](const Item& a, const Item& b) { return a.center[axis] < b.center[axis]; });
    split(items.first(first_half));
    items = items.subspan(first_half);
  }
}

}  // namespace

void order_in_space(const Scene& scene, std::vector<uint32_t>& triangles) {
  std::vector<Item> items;
  items.reserve(triangles.size());
  for (const uint32_t index : triangles) {
    const Triangle& t = scene.triangles[index];
    glm::vec3 center = scene.vertices[t.a].position + scene.vertices[t.b].position + scene.vertices[t.c].position;
    // Comparisons with a NaN would not be an order.
    for (int axis = 0; axis < 3; ++axis) center[axis] = std::isnan(center[axis]) ? 0.0f : center[axis];
    items.push_back({center, index});
  }
  split(items);
  std::transform(items.begin(), items.end(), triangles.begin(), [](const Item& item) { return item.triangle; });
}

}  // namespace lightloom::scene
