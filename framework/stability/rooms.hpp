#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/stability/lab.hpp"
#include "framework/stability/scenes.hpp"

namespace lightloom::stability {

/// The six walls of a box, facing inwards.
[[nodiscard]] std::vector<QuadSpec> box_walls(const glm::vec3& low, const glm::vec3& high, uint32_t material = 0);

/// A closed room of 4 m, -2 to 2 along each axis, with coloured walls, a lamp below the ceiling and a slanting board,
/// one of the walls glossy; seen from within. All corners are multiples of 1/8 m: with a resolution of 34 voxels they
/// lie on borders of voxels, and floats hold them exactly after moving them by any number of voxels up to 1e5.
[[nodiscard]] scene::Scene furnished_room();

/// Size, turn and move of a scene: x -> scale * turn * x + shift. `turn` is orthonormal and may mirror.
struct Placement {
  float scale = 1;
  glm::mat3 turn{1};
  glm::vec3 shift{0};
};

/// The scene with its cameras, placed elsewhere; what sun and punctual lights send is scaled so that the same light
/// arrives. Of a mirrored scene, triangles keep their front.
[[nodiscard]] scene::Scene placed(const scene::Scene& scene, const Placement& placement);

/// Options for the graphs that ship, in small: view, trace and grid of these sizes; raw, without denoiser and history.
[[nodiscard]] RunOptions small_run(uint32_t width, uint32_t height, uint32_t resolution);

/// A small graph: first hits of the view at `width` x `height` to `surface`, voxels, their distances, and `extra`
/// (inner text of passes, with a comma ahead); `outputs` is the inner text of outputs.
[[nodiscard]] std::string small_graph(uint32_t width, uint32_t height, uint32_t resolution, const std::string& extra,
                                      const std::string& outputs);

}  // namespace lightloom::stability
