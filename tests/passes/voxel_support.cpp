#include "tests/passes/voxel_support.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "passes/bundles.hpp"

namespace lightloom::test {
namespace {

void set_features(scene::Scene& scene) {
  for (const scene::Material& material : scene.materials) {
    scene::Features& features = scene.features;
    features.emissive = features.emissive || material.emission != glm::vec3(0);
    features.metallic = features.metallic || material.metallic > 0;
    features.specular = features.specular || material.specular_factor > 0 || material.metallic > 0;
    features.anisotropic = features.anisotropic || material.anisotropy_strength > 0;
    features.alpha = features.alpha || material.alpha_mode == scene::AlphaMode::mask;
    features.textured = features.textured || material.base_color_texture.image >= 0;
    features.normal_mapped = features.normal_mapped || material.normal_texture.image >= 0;
  }
}

}  // namespace

scene::Scene make_triangle_scene(const std::vector<WorldTriangle>& triangles, std::vector<scene::Material> materials) {
  scene::Scene made;
  made.file = "triangles";
  made.materials = std::move(materials);
  made.bounds = {triangles.front()[0], triangles.front()[0]};
  for (const WorldTriangle& corners : triangles) {
    const auto base = static_cast<uint32_t>(made.vertices.size());
    const auto index = static_cast<uint32_t>(made.triangles.size());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const glm::vec3& corner : corners) {
      scene::Vertex vertex;
      vertex.position = corner;
      vertex.normal = normal;
      vertex.tangent = glm::vec4(glm::normalize(corners[1] - corners[0]), 1);
      made.vertices.push_back(vertex);
      made.bounds.min = glm::min(made.bounds.min, corner);
      made.bounds.max = glm::max(made.bounds.max, corner);
    }
    const auto last = static_cast<uint32_t>(made.materials.size()) - 1;
    made.triangles.push_back({base, base + 1, base + 2, std::min(index, last), 0});
  }
  made.objects = {"triangles"};
  made.static_vertex_count = static_cast<uint32_t>(made.vertices.size());
  made.static_triangle_count = static_cast<uint32_t>(made.triangles.size());
  made.cameras = {look_at({0, 0, 5}, {0, 0, 0}, 0.8f)};
  set_features(made);
  return made;
}

std::vector<WorldTriangle> cube_triangles(float half_edge, const glm::mat3& rotation) {
  std::vector<WorldTriangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto corner = [&](float u, float v) {
        glm::vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = side * u;
        p[(axis + 2) % 3] = v;
        return rotation * (half_edge * p);
      };
      triangles.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
      triangles.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
    }
  }
  return triangles;
}

scene::Material plain(const glm::vec3& base_color) {
  scene::Material material;
  material.base_color = glm::vec4(base_color, 1);
  material.metallic = 0;
  material.specular_factor = 0;
  return material;
}

scene::Image make_image(uint32_t width, uint32_t height,
                        const std::function<std::array<uint8_t, 4>(uint32_t, uint32_t)>& color, bool srgb) {
  scene::Image image;
  image.name = "made";
  image.width = width;
  image.height = height;
  image.srgb = srgb;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const std::array<uint8_t, 4> texel = color(x, y);
      image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    }
  }
  return image;
}

PassType make_voxel_pattern() {
  PassType type;
  type.name = "voxel_pattern";
  type.doc = "Random voxels.";
  Port voxels;
  voxels.name = "voxels";
  voxels.direction = Direction::out;
  voxels.bundle = "voxels";
  voxels.parts = passes::voxel_parts();
  voxels.dimension = Dimension::d3;
  voxels.extent = ExtentRule::grid;
  voxels.access = Access::compute_storage_write;
  type.ports = {voxels};
  type.params = {{"resolution", ParamType::integer, int64_t{16}, 3, 512, {}, "voxels", "as of voxelize"},
                 {"salt", ParamType::integer, int64_t{0}, {}, {}, {}, "", "of the random numbers"},
                 {"density", ParamType::real, 0.1, 0, 1, {}, "", "fraction that is occupied"}};
  type.record = [](PassContext& context) {
    context.dispatch({"voxel_pattern.comp", context.output_extent("voxels"), {}});
  };
  return type;
}

Images run_passes(const std::string& passes, const std::string& output, const scene::Scene& scene,
                  GraphRunOptions options) {
  const std::string text = R"({ "lightloom": 1, "name": "test", "view": { "width": 64, "height": 48 },
    "trace": { "width": 32, "height": 24 }, "passes": { )" +
                           passes + R"( }, "outputs": { "output": ")" + output + "\" } }";
  options.capture = {"*"};
  options.extra_types.push_back(make_voxel_pattern());
  return run_graph(text, scene, options).back();
}

Images voxelize(const scene::Scene& scene, int resolution, const std::string& geometry) {
  const std::string pass = R"("v": { "type": "voxelize", "params": { "geometry": ")" + geometry +
                           R"(", "resolution": )" + std::to_string(resolution) + " } }";
  return run_passes(pass, "v.voxels.albedo", scene);
}

bool occupied(const image::HostImage& albedo, const glm::ivec3& voxel) {
  return byte_at(albedo, voxel, 3) == 255;
}

int byte_at(const image::HostImage& image, const glm::ivec3& voxel, uint32_t channel) {
  const glm::uvec3 at(voxel);
  return static_cast<int>(std::lround(image.at(at.x, at.y, at.z, channel) * 255));
}

void for_each_voxel(const image::HostImage& image, const std::function<void(const glm::ivec3&)>& visit) {
  const Extent3& extent = image.desc.extent;
  for (int z = 0; z < static_cast<int>(extent.depth); ++z)
    for (int y = 0; y < static_cast<int>(extent.height); ++y)
      for (int x = 0; x < static_cast<int>(extent.width); ++x) visit({x, y, z});
}

std::vector<WorldTriangle> random_triangles(size_t count, float size, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<WorldTriangle> triangles(count);
  for (WorldTriangle& triangle : triangles) {
    const glm::vec3 center(4 * unit(random), 2 * unit(random), 3 * unit(random));
    for (glm::vec3& corner : triangle)
      corner = center + size * (glm::vec3(unit(random), unit(random), unit(random)) - 0.5f);
  }
  return triangles;
}

GridTriangle in_grid(const run::Grid& grid, const WorldTriangle& triangle) {
  GridTriangle result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = (glm::dvec3(triangle[i]) - glm::dvec3(grid.origin)) / static_cast<double>(grid.voxel);
  return result;
}

}  // namespace lightloom::test
