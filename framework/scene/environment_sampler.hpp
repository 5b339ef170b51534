#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// Size limits of the grid of cells: a finer one would follow the image more closely than its samples are worth.
constexpr uint32_t kEnvironmentColumns = 512;
constexpr uint32_t kEnvironmentRows = 256;

/// Distribution of directions by which the light of an environment is sampled, as shaders/lib/environment.glsl reads
/// it: a grid of cells, even in longitude (column 0 begins at -pi) and in the polar angle (row 0 begins at +y). Cells
/// are picked in proportion to the light that comes out of them, directions within a cell uniformly in solid angle, so
/// the density is constant in a cell.
///
/// Probabilities are multiples of 2^-24, as are the random numbers that they are compared with: each cell is picked
/// with exactly the probability that its density says. A cell in which the bilinearly filtered image is not black
/// anywhere has a probability above 0.
struct EnvironmentTable {
  uint32_t columns = 1;
  uint32_t rows = 1;
  /// (columns + 1) * rows, row by row. Texel (c, r) with c < columns: probability of a column up to and including c in
  /// row r; density in cell (c, r) [sr^-1]. Texel (columns, r): probability of a row up to and including r; cosine of
  /// the polar angle at which row r ends.
  std::vector<glm::vec2> texels;
};

/// Radiance of a texel of the environment's image before its scale. What is no finite number of at least 0 counts as 0:
/// one such texel would darken or lighten all that is sampled and filtered. Files that hold one are refused
/// (images.hpp); this is for scenes made in memory.
[[nodiscard]] inline float environment_texel(const Environment& environment, size_t index) {
  const float value = environment.rgb[index];
  return std::isfinite(value) && value >= 0 ? value : 0.0f;
}

/// A constant environment is one cell: uniform over the sphere. Where all is black, every probability and density is 0.
[[nodiscard]] EnvironmentTable build_environment_table(const Environment& environment);

}  // namespace lightloom::scene
