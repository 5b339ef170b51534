#include "tests/support/tracing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/finish.hpp"

namespace lightloom::test {

uint32_t SceneBuilder::material(const scene::Material& material) {
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t SceneBuilder::image(uint32_t width, uint32_t height, std::vector<uint8_t> rgba) {
  scene::Image image;
  image.name = "made";
  image.width = width;
  image.height = height;
  image.rgba = std::move(rgba);
  scene.images.push_back(std::move(image));
  return static_cast<uint32_t>(scene.images.size() - 1);
}

void SceneBuilder::triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, uint32_t material) {
  const auto first = static_cast<uint32_t>(scene.vertices.size());
  const glm::vec3 normal(glm::normalize(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a))));
  for (const glm::vec3& corner : {a, b, c}) {
    scene::Vertex vertex;
    vertex.position = corner;
    vertex.normal = normal;
    vertex.tangent = glm::vec4(glm::normalize(b - a), 1);
    scene.vertices.push_back(vertex);
  }
  scene.triangles.push_back({first, first + 1, first + 2, material, 0});
}

void SceneBuilder::quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, uint32_t material,
                        float repeats) {
  const size_t first = scene.vertices.size();
  triangle(corner, corner + u, corner + u + v, material);
  triangle(corner, corner + u + v, corner + v, material);
  const glm::vec2 coordinates[] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  for (size_t i = 0; i < 6; ++i) {
    scene.vertices[first + i].u0 = coordinates[i].x * repeats;
    scene.vertices[first + i].v0 = coordinates[i].y * repeats;
    scene.vertices[first + i].tangent = glm::vec4(glm::normalize(u), 1);
  }
}

void SceneBuilder::room(const glm::vec3& low, const glm::vec3& high, uint32_t material) {
  const glm::vec3 d = high - low;
  const glm::vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  quad(low, y, z, material);
  quad(low, z, x, material);
  quad(low, x, y, material);
  quad(high, -z, -y, material);
  quad(high, -x, -z, material);
  quad(high, -y, -x, material);
}

scene::Scene SceneBuilder::finish(const scene::Camera& camera) {
  scene.static_vertex_count = static_cast<uint32_t>(scene.vertices.size());
  scene.static_triangle_count = static_cast<uint32_t>(scene.triangles.size());
  scene.cameras = {camera};
  if (!scene.vertices.empty()) scene.bounds = {scene.vertices[0].position, scene.vertices[0].position};
  for (const scene::Vertex& vertex : scene.vertices) {
    scene.bounds.min = glm::min(scene.bounds.min, vertex.position);
    scene.bounds.max = glm::max(scene.bounds.max, vertex.position);
  }
  scene.features = scene::find_features(scene);
  return scene;
}

scene::Material matte(const glm::vec3& base_color, const glm::vec3& emission) {
  scene::Material material;
  material.base_color = glm::vec4(base_color, 1);
  material.emission = emission;
  material.metallic = 0;
  material.specular_factor = 0;
  return material;
}

scene::Material white_metal(float roughness) {
  scene::Material material;
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

scene::Camera perspective(const glm::vec3& eye, const glm::vec3& target, float vertical_fov, const glm::vec3& up) {
  scene::Camera camera;
  camera.world_from_camera = glm::mat4(glm::inverse(glm::lookAt(glm::dvec3(eye), glm::dvec3(target), glm::dvec3(up))));
  camera.vertical_fov = vertical_fov;
  return camera;
}

scene::Camera flat_view(const glm::vec3& centre, const glm::vec3& direction, float half_height, const glm::vec3& up) {
  scene::Camera camera = perspective(centre - direction, centre, 1, up);
  camera.perspective = false;
  camera.half_height = half_height;
  return camera;
}

Traced trace(const scene::Scene& scene, const reference::ImageSettings& settings, const TraceOptions& options) {
  const scene::Pose pose =
      scene.source ? scene::pose(scene, options.time) : scene::Pose{{}, scene.cameras, scene.punctual};
  scene::FrameScene frame;
  frame.scene = &scene;
  frame.pose = &pose;
  const reference::StaticScene fixed(scene);
  const reference::TriangleGeometry geometry(fixed, frame);
  const reference::Lights lights{reference::SunLight(scene.sun, options.sun), &fixed.environment,
                                 reference::PunctualLights(pose.punctual)};
  const reference::PixelCamera camera(pose.cameras.at(options.camera), settings.width, settings.height, scene.bounds);
  Traced result{settings.width, settings.height, std::vector<reference::TracedPixel>(settings.width * settings.height)};
  reference::trace_image(
      geometry, lights, settings, !options.box,
      [&](uint32_t x, uint32_t y, const reference::PathRandom& random) {
        const glm::vec2 place = options.box ? random.pair(0, reference::Decision::pixel) : glm::vec2(0.5f);
        return reference::hit_through(geometry, camera, x + static_cast<double>(place.x),
                                      y + static_cast<double>(place.y));
      },
      [&](uint32_t x, uint32_t y, const reference::TracedPixel& pixel) {
        result.pixels[y * result.width + x] = pixel;
      });
  return result;
}

Estimate trace_pixel(const scene::Scene& scene, uint32_t paths, uint32_t bounces, const TraceOptions& options,
                     reference::WardForm ward, reference::Strategy strategy) {
  reference::ImageSettings settings;
  settings.paths = paths;
  settings.path = {bounces, ward, strategy};
  const Traced traced = trace(scene, settings, options);
  return {static_cast<double>(traced.at(0, 0).outgoing.r), static_cast<double>(traced.at(0, 0).standard_error.r)};
}

void expect_agrees(const Estimate& estimate, double expected, const std::string& what, double rounding) {
  EXPECT_NEAR(estimate.mean, expected, 4.5 * estimate.error + rounding * std::abs(expected))
      << what << ", standard error " << estimate.error;
}

}  // namespace lightloom::test
