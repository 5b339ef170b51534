#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/reference/trace_image.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::test {

/// Makes static scenes triangle by triangle.
class SceneBuilder {
 public:
  /// Returns the material's index.
  uint32_t material(const scene::Material& material);
  uint32_t image(uint32_t width, uint32_t height, std::vector<uint8_t> rgba);
  void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, uint32_t material);
  /// Seen from the side of cross(u, v), the front; texture coordinates go from 0 to `repeats` along u and v.
  void quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, uint32_t material, float repeats = 1);
  /// The six faces of a box, fronts inside.
  void room(const glm::vec3& low, const glm::vec3& high, uint32_t material);
  /// With sun, environment and lights that were added to `scene` before.
  [[nodiscard]] scene::Scene finish(const scene::Camera& camera);

  scene::Scene scene;
};

/// Neither metallic nor specular; emits on its front alone.
scene::Material matte(const glm::vec3& base_color, const glm::vec3& emission = glm::vec3(0));
/// A white metal: its lobe reflects what Ward's form does.
scene::Material white_metal(float roughness);

scene::Camera perspective(const glm::vec3& eye, const glm::vec3& target, float vertical_fov, const glm::vec3& up);
/// Looks along `direction` at a square of 2 * half_height around `centre`.
scene::Camera flat_view(const glm::vec3& centre, const glm::vec3& direction, float half_height, const glm::vec3& up);

struct TraceOptions {
  reference::SunModel sun = reference::SunModel::disc;
  bool box = false;  ///< pixel filter
  double time = 0;   ///< [s]
  size_t camera = 0;
};

struct Traced {
  uint32_t width = 0, height = 0;
  std::vector<reference::TracedPixel> pixels;

  [[nodiscard]] const reference::TracedPixel& at(uint32_t x, uint32_t y) const { return pixels[y * width + x]; }
};

/// An image by the library alone.
Traced trace(const scene::Scene& scene, const reference::ImageSettings& settings, const TraceOptions& options = {});

/// Of a single pixel in double: mean and standard error of its red channel.
struct Estimate {
  double mean = 0, error = 0;
};
Estimate trace_pixel(const scene::Scene& scene, uint32_t paths, uint32_t bounces, const TraceOptions& options = {},
                     reference::WardForm ward = reference::WardForm::bounded,
                     reference::Strategy strategy = reference::Strategy::mis);

/// Fails where an estimate is more than 4.5 standard errors and `rounding` (relative) away from `expected`.
void expect_agrees(const Estimate& estimate, double expected, const std::string& what, double rounding = 1e-5);

}  // namespace lightloom::test
