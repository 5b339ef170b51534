#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::stability {

/// Writes a scene as NAME.gltf with NAME.bin, all in one node moved by `shift` [m, in double], and NAME.scene.json with
/// the scene's first camera, looking along the same way, moved too; returns the latter. Geometry, base colours,
/// emission and specular reflection alone; `raw_triangles` more triangles are appended as they are, three corners each.
[[nodiscard]] std::filesystem::path write_scene(const std::filesystem::path& folder, const std::string& name,
                                                const scene::Scene& scene, const glm::dvec3& shift = glm::dvec3(0),
                                                const std::vector<glm::vec3>& raw_triangles = {});

}  // namespace lightloom::stability
