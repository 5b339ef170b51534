#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/graph/link.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::test {

struct GraphRunOptions {
  uint32_t frames = 1;  ///< rendered one after another from frame 0
  uint32_t seed = 0;
  bool share_memory = true;
  std::optional<double> frozen_time;  ///< [s]
  std::string camera;                 ///< empty: the scene's first
  std::vector<std::string> capture;   ///< globs over "pass.port" / "pass.port.part"
  LinkOptions link;
  /// Pass types on top of the built-in ones, e.g. one that fills an image with a pattern by a shader in
  /// tests/passes/shaders, which is searched after shaders/.
  std::vector<PassType> extra_types;
};

/// Outputs by name and captures by "pass.port[.part]".
using Images = std::map<std::string, image::HostImage>;

/// Called with each frame's images.
using FrameVisitor = std::function<void(uint32_t frame, Images images)>;

/// Runs a graph on the test device (validation on) and shows every frame's images. Diagnostics are thrown as
/// std::runtime_error with their text.
void visit_frames(std::string_view graph_json, const scene::Scene& scene, const GraphRunOptions& options,
                  const FrameVisitor& visit);

/// Runs a graph on the test device (validation on) and returns every frame's images. Diagnostics are thrown as
/// std::runtime_error with their text.
std::vector<Images> run_graph(std::string_view graph_json, const scene::Scene& scene,
                              const GraphRunOptions& options = {});

/// White, no specular reflection, double sided.
scene::Material white_lambertian();

/// A static scene of quads, each an object of its own. Without `materials`: white Lambertian. The feature `specular` is
/// set; sun, environment and punctual lights may be added by the caller, together with their features.
struct QuadSpec {
  glm::vec3 corner, edge_u, edge_v;  ///< counter-clockwise seen from the side of cross(edge_u, edge_v)
  uint32_t material = 0;
};
scene::Scene make_quad_scene(const std::vector<QuadSpec>& quads, std::vector<scene::Material> materials,
                             const scene::Camera& camera);

/// Perspective camera at `eye` looking at `target`.
scene::Camera look_at(const glm::vec3& eye, const glm::vec3& target, float vertical_fov_radians,
                      const glm::vec3& up = {0, 1, 0});

}  // namespace lightloom::test
