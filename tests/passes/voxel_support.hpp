#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/grid.hpp"
#include "framework/scene/scene.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/voxel_oracle.hpp"

namespace lightloom::test {

/// A corner of a test triangle; what is not set does not matter to the test.
using WorldTriangle = std::array<glm::vec3, 3>;

/// A static scene of loose triangles, triangle i of material min(i, materials - 1); flat normals.
scene::Scene make_triangle_scene(const std::vector<WorldTriangle>& triangles, std::vector<scene::Material> materials);

/// The six faces of the cube around the origin with that half edge, turned by `rotation`, seen from outside.
std::vector<WorldTriangle> cube_triangles(float half_edge, const glm::mat3& rotation);

/// With corners up to `size` / 2 [m] on each axis from random centers in the box from 0 to (4, 2, 3).
std::vector<WorldTriangle> random_triangles(size_t count, float size, uint32_t seed);

/// Material of one colour without specular reflection.
scene::Material plain(const glm::vec3& base_color);

/// sRGB image whose texel (x, y) is `color(x, y)`.
scene::Image make_image(uint32_t width, uint32_t height,
                        const std::function<std::array<uint8_t, 4>(uint32_t, uint32_t)>& color, bool srgb = true);

/// Test pass: `voxels` out on the grid of its param `resolution`, random by `salt`, with the fraction `density`
/// occupied.
PassType make_voxel_pattern();

/// Graph of the given passes (inner text), view 64x48, trace 32x24; everything is captured, `output` is its one output.
Images run_passes(const std::string& passes, const std::string& output, const scene::Scene& scene,
                  GraphRunOptions options = {});

/// `voxelize` alone as pass "v".
Images voxelize(const scene::Scene& scene, int resolution, const std::string& geometry = "all");

bool occupied(const image::HostImage& albedo, const glm::ivec3& voxel);

/// Channel value of an 8-bit image, 0..255.
int byte_at(const image::HostImage& image, const glm::ivec3& voxel, uint32_t channel);

/// Calls `visit` for every voxel of the image.
void for_each_voxel(const image::HostImage& image, const std::function<void(const glm::ivec3&)>& visit);

GridTriangle in_grid(const run::Grid& grid, const WorldTriangle& triangle);

}  // namespace lightloom::test
