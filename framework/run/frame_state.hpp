#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/graph/desc.hpp"
#include "framework/run/scene_layout.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// How world space appears in the image.
struct View {
  glm::mat4 view_projection{1};  ///< world to Vulkan clip space: y down, depth 0..1
  glm::vec4 eye{0, 0, 0, 1};     ///< position [m], w = 1; orthographic: unit direction towards the viewer, w = 0
};

/// The view of `camera` in an image of `extent` pixels. The vertical field of view is the camera's; the horizontal one
/// follows from the extent. The near and far planes enclose `bounds`.
[[nodiscard]] View view_of(const scene::Camera& camera, const Extent3& extent, const scene::Bounds& bounds);

/// What a frame's blocks are made from.
struct FrameInputs {
  uint32_t frame = 0;  ///< absolute frame index
  uint32_t seed = 0;
  uint32_t history_length = 0;  ///< earlier frames that the history rings hold
  std::vector<View> views;      ///< [age], newest first, 1 to kHistoryLimit of them
  uint32_t hint_count = 0;
  uint32_t newest_slot = 0;  ///< of the past positions; as many are filled as there are views
};

[[nodiscard]] FrameBlock make_frame_block(const scene::Scene& scene, const FrameInputs& inputs);

/// Punctual lights as the shaders see them. Throws Error(invalid_input) for more than kPunctualLimit lights.
[[nodiscard]] std::vector<PunctualEntry> make_punctual_entries(const std::vector<scene::PunctualLight>& lights);

}  // namespace lightloom::run
