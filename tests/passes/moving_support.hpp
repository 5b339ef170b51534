#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "framework/scene/scene.hpp"
#include "tests/passes/voxel_support.hpp"

namespace lightloom::test {

/// Where an object is in one frame.
struct Placement {
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};
  float scale = 1;
};

struct MovingObject {
  std::vector<WorldTriangle> triangles;  ///< in the object's space
  scene::Material material;
  std::vector<Placement> placements;  ///< by frame, of 30 a second; as many for every object of a scene
};

/// `scene`, which has no dynamic triangles yet, with moving objects; its bounds stay what they are.
scene::Scene with_moving(scene::Scene scene, const std::vector<MovingObject>& objects);

}  // namespace lightloom::test
