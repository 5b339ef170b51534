#include "framework/reference/first_hits.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace lightloom::reference {
namespace {

constexpr float kLeastModulation = 1e-3f;

void set_modulation(FirstHit& hit, const Reflectance& reflectance, float cosine) {
  const Lobes fractions = reflected_fractions(reflectance, cosine);
  hit.modulation = {glm::max(fractions.diffuse, kLeastModulation), glm::max(fractions.specular, kLeastModulation)};
  hit.modulation_sum = glm::max(fractions.sum(), kLeastModulation);
}

}  // namespace

FirstHit hit_through(const TriangleGeometry& geometry, const PixelCamera& camera, double x, double y) {
  FirstHit hit;
  hit.ray = camera.through(x, y);
  const std::optional<TrianglePoint> seen = geometry.seen(camera, hit.ray);
  if (!seen) return hit;
  hit.surface = geometry.seen_surface(camera, hit.ray, *seen);
  const SurfacePoint& point = hit.surface->point;
  set_modulation(hit, point.reflectance, -glm::dot(point.normal, glm::vec3(hit.ray.direction)));
  return hit;
}

FirstHit hit_of_surface(const TriangleGeometry& geometry, const PixelCamera& camera, const SurfaceImages& images,
                        uint32_t x, uint32_t y) {
  const size_t pixel = size_t{y} * images.width + x;
  const glm::vec4 position = images.position[pixel];
  FirstHit hit;
  // The G-buffer may be coarser than the image of the camera.
  const glm::dvec2 scale = camera.pixels() / glm::dvec2(images.width, images.height);
  hit.ray = camera.through((x + 0.5) * scale.x, (y + 0.5) * scale.y);
  if (!(position.w > 0)) return hit;
  const uint32_t triangle = images.id[pixel].z;
  if (triangle >= geometry.triangles().scene().triangles.size())
    throw Error(ExitCode::invalid_input,
                "reference_path_trace: input 'surface' names triangle " + std::to_string(triangle) +
                    ", but the scene has " + std::to_string(geometry.triangles().scene().triangles.size()),
                "connect it to a gather or resample_surface pass of the same graph");
  hit.ray = camera.towards(glm::vec3(position));
  const std::optional<TrianglePoint> point = geometry.triangles().on_triangle(triangle, hit.ray);
  if (!point) return hit;
  hit.surface = geometry.seen_surface(camera, hit.ray, *point);
  const glm::vec4 albedo = images.albedo[pixel], material = images.material[pixel];
  const glm::vec3 to_viewer = camera.to_viewer(glm::vec3(position));
  const glm::vec3 normal = facing(glm::normalize(glm::vec3(images.normal[pixel])), to_viewer);
  set_modulation(hit, {glm::vec3(albedo), albedo.w, material.z, material.w, glm::vec2(material)},
                 glm::dot(normal, to_viewer));
  return hit;
}

}  // namespace lightloom::reference
