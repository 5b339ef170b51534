#pragma once

#include <glm/glm.hpp>
#include <string>

#include "tests/passes/light_support.hpp"
#include "tests/passes/voxel_support.hpp"

namespace lightloom::test {

// The view of `gather` and `front_camera`.
constexpr int kViewWidth = 64;
constexpr int kViewHeight = 48;
constexpr float kFieldOfView = 0.8f;
constexpr uint32_t kX = 0, kY = 1, kZ = 2, kW = 3;

/// A pass "g" of type `gather` on a view of 64x48; everything is captured.
Images gather(const scene::Scene& scene);

/// A pixel of a part of the surface; of `id` object + 1 and material alone.
glm::dvec4 texel(const Images& images, const std::string& part, int x, int y);
glm::dvec3 direction(const Images& images, const std::string& part, int x, int y);

/// From (0, 0, distance) along -z.
scene::Camera front_camera(float distance);

/// Direction of depth 1 of the front camera's ray through a point of the view [pixels, y down].
glm::dvec3 front_ray(double x, double y);

/// Where the ray through a pixel's centre, from (0,0,distance) along -z, meets the plane z = 0 turned by `slope` in x.
glm::dvec3 on_plane(int x, int y, double distance, double slope);

/// Around (0, 0, z), seen by the front camera.
QuadSpec facing_quad(float z, float half_width, float half_height, uint32_t material = 0);

}  // namespace lightloom::test
