#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace lightloom::run {

// Mirrors of the blocks in shaders/lib/scene.glsl, std140. tests/run/scene_layout_test.cpp compares every offset with
// the reflection of a shader that uses the blocks.

constexpr uint32_t kHistoryLimit = 16;
constexpr uint32_t kEmissionLimit = 256;
constexpr uint32_t kHintLimit = 1024;
constexpr uint32_t kPunctualLimit = 64;
constexpr uint32_t kGeometryPieces = 4;

struct FrameBlock {
  glm::mat4 view_projection[kHistoryLimit];
  glm::vec4 eye[kHistoryLimit];
  glm::mat4 inverse_view_projection;
  glm::uvec4 ids;
  glm::vec4 scene_min;
  glm::vec4 scene_max;
  glm::vec4 sun_direction;
  glm::vec4 sun_irradiance;
  glm::vec4 environment;
  glm::uvec4 counts;
  glm::uvec4 motion;
};
static_assert(sizeof(FrameBlock) == kHistoryLimit * 80 + 64 + 8 * 16);

struct EmissionEntry {
  glm::vec4 radiance;
  glm::vec4 sides;
};

struct EmitterEntry {
  glm::vec4 surface;
};

struct HintEntry {
  glm::vec4 position;
  glm::vec4 normal;
};

struct PunctualEntry {
  glm::vec4 position;
  glm::vec4 direction;
  glm::vec4 intensity;
  glm::vec4 cone;
};

struct LightBlock {
  EmissionEntry emissions[kEmissionLimit];
  EmitterEntry emitters[kEmissionLimit];
  HintEntry hints[kHintLimit];
  PunctualEntry punctual[kPunctualLimit];
};
static_assert(sizeof(LightBlock) <= 65536, "the least maxUniformBufferRange that devices in use offer");

}  // namespace lightloom::run
