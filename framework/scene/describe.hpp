#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::scene {

struct ImageSummary {
  std::string name;
  uint32_t width = 0, height = 0;
  bool srgb = false;
};

/// What is in a scene, as plain data for text and for machines.
struct SceneSummary {
  std::string file;
  size_t static_triangles = 0, dynamic_triangles = 0, vertices = 0, objects = 0, materials = 0;
  size_t emissive_triangles = 0;
  std::vector<ImageSummary> images;
  std::vector<std::string> cameras;  ///< the first is the default
  std::vector<std::string> punctual_lights;
  size_t animated_clips = 0;
  double duration = 0;  ///< longest clip [s]
  Bounds bounds;
  std::vector<std::pair<std::string, bool>> features;
  std::vector<std::string> warnings;
};

[[nodiscard]] SceneSummary summarise(const Scene& scene);

/// A few lines for people, ending with a newline.
[[nodiscard]] std::string describe(const Scene& scene);

}  // namespace lightloom::scene
