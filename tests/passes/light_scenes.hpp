#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/graph_runner.hpp"

namespace lightloom::test {

/// Mean of independent numbers, and its standard error.
class SampleMean {
 public:
  void add(double value) {
    ++count_;
    const double change = value - mean_;
    mean_ += change / count_;
    squares_ += change * (value - mean_);
  }
  [[nodiscard]] double count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double variance() const { return squares_ / (count_ - 1); }
  [[nodiscard]] double error() const { return std::sqrt(variance() / count_); }

 private:
  double count_ = 0, mean_ = 0, squares_ = 0;
};

/// How a tracer test runs: a square image, voxels on the longest axis, frames with random numbers of their own.
struct TraceSettings {
  std::string params;  ///< of voxel_path_trace, as JSON members
  uint32_t size = 32;
  int resolution = 32;
  uint32_t frames = 1;
  uint32_t seed = 1;
};

/// Frames of "radiance" (of voxel_path_trace: divided by the modulation colour), "position" and "material" (what
/// `gather` saw).
std::vector<Images> trace_frames(const scene::Scene& scene, const TraceSettings& settings);

/// Means of a channel of the radiance over blocks of `block` x `block` pixels in each frame, row by row of blocks.
std::vector<SampleMean> block_estimates(const std::vector<Images>& frames, uint32_t channel, uint32_t block);

/// Mean of a channel over all lit pixels, one number a frame: give enough frames for a standard error.
SampleMean frame_estimate(const std::vector<Images>& frames, uint32_t channel);

/// Adds every lit pixel of [x0, x1) x [0, height): for parts of an image whose pixels all have the same expectation.
void add_pixels(SampleMean& estimate, const Images& images, uint32_t channel, uint32_t x0, uint32_t x1);

/// Orthographic camera at `eye` looking at `target`; the image is 2 * half_height high [m].
scene::Camera orthographic(const glm::vec3& eye, const glm::vec3& target, float half_height,
                           const glm::vec3& up = {0, 0, -1});

/// Position of the surface in a pixel [m].
glm::dvec3 surface_position(const Images& images, uint32_t x, uint32_t y);

/// A square floor around the origin that faces up, `half_width` to each side.
QuadSpec square_floor(float half_width, uint32_t material = 0);

scene::Material glossy_floor();

/// A glossy floor and wall, a lamp along the grid and one across it, of these materials, and a post between them.
scene::Scene lamps_scene(const scene::Material& along, const scene::Material& across);

/// The six walls of a box, facing inwards.
std::vector<QuadSpec> room_walls(const glm::vec3& low, const glm::vec3& high, uint32_t material);

/// A wall without thickness between two rooms, and to which its normal points.
enum class Partition : uint8_t { none, faces_lamp, faces_away };

/// Two rooms side by side with a lamp in one, seen from the other; all of it turned.
scene::Scene two_rooms(const glm::mat3& turn, Partition partition);

/// A turn around y and one around x before it [radians].
glm::mat3 turned(float around_y, float around_x);

}  // namespace lightloom::test
