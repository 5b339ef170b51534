#include "tests/passes/gather_support.hpp"

#include <cmath>

namespace lightloom::test {

Images gather(const scene::Scene& scene) {
  return run_passes(R"("g": { "type": "gather" })", "g.surface.position", scene);
}

glm::dvec4 texel(const Images& images, const std::string& part, int x, int y) {
  const image::HostImage& image = images.at("g.surface." + part);
  const auto at = [&](uint32_t channel) {
    return image.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0, channel);
  };
  if (part == "id") return {at(kX), at(kY), 0, 0};
  return {at(kX), at(kY), at(kZ), at(kW)};
}

glm::dvec3 direction(const Images& images, const std::string& part, int x, int y) {
  return glm::dvec3(texel(images, part, x, y));
}

scene::Camera front_camera(float distance) {
  return look_at({0, 0, distance}, {0, 0, 0}, kFieldOfView);
}

glm::dvec3 front_ray(double x, double y) {
  const double half = std::tan(kFieldOfView / 2);
  return {(2 * x / kViewWidth - 1) * half * kViewWidth / kViewHeight, (1 - 2 * y / kViewHeight) * half, -1};
}

glm::dvec3 on_plane(int x, int y, double distance, double slope) {
  const glm::dvec3 ray = front_ray(x + 0.5, y + 0.5);
  const double t = distance / (1 + slope * ray.x);  // z = slope * x
  return glm::dvec3(0, 0, distance) + t * ray;
}

QuadSpec facing_quad(float z, float half_width, float half_height, uint32_t material) {
  return {{-half_width, -half_height, z}, {2 * half_width, 0, 0}, {0, 2 * half_height, 0}, material};
}

}  // namespace lightloom::test
