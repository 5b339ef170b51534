// The committed sample scene: that the generator still writes it, and that it is what samples/README.md says.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "samples/scenes/atrium_reader.hpp"

namespace lightloom::samples {
namespace {

namespace fs = std::filesystem;
const fs::path kFolder = fs::path(LIGHTLOOM_SOURCE_DIR) / "samples/scenes";

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

glm::dvec3 vector_of(const nlohmann::json& list) {
  return {list.at(0), list.at(1), list.at(2)};
}

const AtriumReader& scene() {
  static const AtriumReader reader(kFolder / "atrium/atrium.gltf");
  return reader;
}

const nlohmann::json& scene_file() {
  static const nlohmann::json json = nlohmann::json::parse(bytes_of(kFolder / "atrium.scene.json"));
  return json;
}

glm::dvec3 towards_sun() {
  return -glm::normalize(vector_of(scene_file().at("sun").at("direction")));
}

/// Where a point appears in a 4:3 picture: x and y in -1..1 inside, z its depth [m].
glm::dvec3 project(const nlohmann::json& camera, glm::dvec3 point) {
  const glm::dvec3 eye = vector_of(camera.at("eye"));
  const glm::dvec3 ahead = glm::normalize(vector_of(camera.at("target")) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, vector_of(camera.at("up"))));
  const double slope = std::tan(camera.at("vertical_fov_degrees").get<double>() * std::numbers::pi / 360);
  const double depth = glm::dot(point - eye, ahead);
  return {glm::dot(point - eye, right) / (depth * slope * 4 / 3),
          glm::dot(point - eye, glm::cross(right, ahead)) / (depth * slope), depth};
}

bool in_picture(const nlohmann::json& camera, glm::dvec3 point) {
  const glm::dvec3 place = project(camera, point);
  return place.z > 0 && std::abs(place.x) < 0.97 && std::abs(place.y) < 0.97;
}

bool sees(const nlohmann::json& camera, glm::dvec3 point) {
  const glm::dvec3 eye = vector_of(camera.at("eye"));
  const auto hit = scene().cast(eye, glm::normalize(point - eye));
  return in_picture(camera, point) && hit && hit->distance > glm::distance(eye, point) - 1e-3;
}

TEST(Atrium, GeneratorWritesTheCommittedFiles) {
  const fs::path fresh = ATRIUM_BUILD_FOLDER;
  fs::remove_all(fresh);
  ASSERT_EQ(std::system(("\"" MAKE_ATRIUM "\" \"" + fresh.string() + "\"").c_str()), 0);
  std::set<std::string> names;
  for (const fs::path& folder : {fresh, kFolder / "atrium"}) {
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names.size(), 8u);
  uintmax_t size = 0;
  for (const std::string& name : names) {
    const std::string committed = bytes_of(kFolder / "atrium" / name);
    size += committed.size();
    EXPECT_TRUE(committed == bytes_of(fresh / name)) << name << " differs from what make_atrium writes";
  }
  EXPECT_LT(size, 2'000'000u);
}

TEST(Atrium, SizeAndTriangleCount) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const SceneTriangle& triangle : scene().triangles) {
    for (const Corner& corner : triangle.corners) {
      low = glm::min(low, corner.position);
      high = glm::max(high, corner.position);
    }
  }
  EXPECT_LT(glm::distance(low, glm::dvec3(-6, -0.3, -4)), 1e-4);
  EXPECT_LT(glm::distance(high, glm::dvec3(6, 5.7, 4)), 1e-4);
  EXPECT_GT(scene().triangles.size(), 5'000u);
  EXPECT_LT(scene().triangles.size(), 30'000u);
}

TEST(Atrium, NormalsTangentsAndTexturesFitTheTriangles) {
  for (const SceneTriangle& triangle : scene().triangles) {
    const auto& [a, b, c] = triangle.corners;
    const glm::dvec3 e1 = b.position - a.position, e2 = c.position - a.position;
    const glm::dvec2 t1 = b.uv - a.uv, t2 = c.uv - a.uv;
    const double doubled_area = glm::length(glm::cross(e1, e2)), uv_area = t1.x * t2.y - t1.y * t2.x;
    ASSERT_GT(doubled_area, 1e-7) << triangle.node;
    ASSERT_GT(std::abs(uv_area), 1e-9) << triangle.node;
    const glm::dvec3 face = glm::cross(e1, e2) / doubled_area;
    const glm::dvec3 along_u = glm::normalize((e1 * t2.y - e2 * t1.y) / uv_area);
    const glm::dvec3 along_v = glm::normalize((e2 * t1.x - e1 * t2.x) / uv_area);
    for (const Corner& corner : triangle.corners) {
      const glm::dvec3 tangent(corner.tangent);
      const glm::dvec3 bitangent = glm::cross(corner.normal, tangent) * corner.tangent.w;
      ASSERT_NEAR(glm::length(corner.normal), 1, 1e-4) << triangle.node;
      ASSERT_NEAR(glm::length(tangent), 1, 1e-4) << triangle.node;
      ASSERT_NEAR(glm::dot(corner.normal, tangent), 0, 1e-4) << triangle.node;
      ASSERT_EQ(std::abs(corner.tangent.w), 1) << triangle.node;
      ASSERT_GT(glm::dot(face, corner.normal), 0.7) << triangle.node;
      ASSERT_GT(glm::dot(along_u, tangent), 0.7) << triangle.node;
      ASSERT_LT(glm::dot(along_v, bitangent), -0.7) << triangle.node;
    }
  }
}

// From inside, every way out leads through the roof opening, and nothing shows its back.
TEST(Atrium, ClosedButForTheRoofOpening) {
  std::vector<glm::dvec3> origins{{-5, 0.4, 3.2}, {5.2, 4.6, -3.2}, {0, 3.2, 0}};
  for (const auto& camera : scene_file().at("cameras")) origins.push_back(vector_of(camera.at("eye")));
  constexpr int kDirections = 600;
  int escaped = 0;
  for (const glm::dvec3& origin : origins) {
    for (int i = 0; i < kDirections; ++i) {
      const double y = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - y * y), angle = 2.399963 * i + 0.1;
      const glm::dvec3 direction(r * std::cos(angle), y, r * std::sin(angle));
      if (const auto hit = scene().cast(origin, direction)) {
        EXPECT_TRUE(hit->front || hit->triangle->double_sided) << hit->triangle->node << " seen from behind";
        continue;
      }
      ++escaped;
      ASSERT_GT(y, 0);
      const glm::dvec3 exit = origin + direction * ((5.4 - origin.y) / y);
      EXPECT_TRUE(exit.x > -2.2 && exit.x < 2.6 && exit.z > -2.2 && exit.z < 1.3)
          << "way out at " << exit.x << " " << exit.z;
    }
  }
  EXPECT_GT(escaped, 50);
}

TEST(Atrium, SunReachesFloorAndLowerWallInView) {
  const nlohmann::json& nave = scene_file().at("cameras").at("nave");
  constexpr double kStep = 0.1;
  double floor = 0, wall = 0;  // [m^2] sunlit and seen
  for (double x = -5.65; x < 5.7; x += kStep) {
    for (double z = -2.05; z < 3.7; z += kStep) {
      const glm::dvec3 point(x, 0, z);
      if (in_picture(nave, point) && !scene().cast(point, towards_sun()) && sees(nave, point)) floor += kStep * kStep;
    }
    for (double y = 0.05; y < 2; y += kStep) {
      const glm::dvec3 point(x, y, 3.7);
      if (in_picture(nave, point) && !scene().cast(point, towards_sun()) && sees(nave, point)) wall += kStep * kStep;
    }
  }
  RecordProperty("sunlit_floor_cm2", static_cast<int>(floor * 10000));
  RecordProperty("sunlit_wall_cm2", static_cast<int>(wall * 10000));
  EXPECT_GT(floor, 2);
  EXPECT_GT(wall, 0.2);
  for (const std::string node : {"urn", "mobile"}) {
    EXPECT_FALSE(scene().cast(scene().centre(node) + 0.6 * towards_sun(), towards_sun())) << node << " is in the shade";
  }
}

TEST(Atrium, NaveCameraSeesWhatMatters) {
  const nlohmann::json& cameras = scene_file().at("cameras");
  for (const std::string node : {"urn", "mobile", "plant", "nave lamp"}) {
    const glm::dvec3 point = scene().centre(node), eye = vector_of(cameras.at("nave").at("eye"));
    const auto hit = scene().cast(eye, glm::normalize(point - eye));
    ASSERT_TRUE(hit);
    EXPECT_TRUE(in_picture(cameras.at("nave"), point)) << node;
    EXPECT_EQ(hit->triangle->node, node);
  }
  EXPECT_LT(glm::length(glm::dvec2(project(cameras.at("detail"), scene().centre("urn")))), 0.3);
}

TEST(Atrium, AnimationLoopsInFourSeconds) {
  const tinygltf::Animation& animation = scene().model.animations.at(0);
  ASSERT_EQ(animation.channels.size(), 2u);
  for (const auto& channel : animation.channels) {
    const auto& sampler = animation.samplers.at(channel.sampler);
    const auto times = scene().values(sampler.input), keys = scene().values(sampler.output);
    const size_t width = keys.size() / times.size();
    EXPECT_EQ(times.front(), 0);
    EXPECT_EQ(times.back(), 4);
    const double sign = channel.target_path == "rotation" ? -1 : 1;  // q and -q are the same turn
    double travel = 0;
    for (size_t i = 0; i < width; ++i) {
      EXPECT_NEAR(keys[i], sign * keys[keys.size() - width + i], 1e-5);
      travel = std::max(travel, std::abs(keys[i] - keys[width * 4 + i]));
    }
    EXPECT_GT(travel, 0.1);
  }
}

TEST(Atrium, AccessorBoundsAreExactAndNothingIsUnused) {
  const tinygltf::Model& model = scene().model;
  std::set<int> accessors, materials, meshes, textures;
  for (const auto& mesh : model.meshes) {
    for (const auto& primitive : mesh.primitives) {
      for (const auto& [name, accessor] : primitive.attributes) accessors.insert(accessor);
      accessors.insert(primitive.indices);
      materials.insert(primitive.material);
      const auto& positions = model.accessors.at(primitive.attributes.at("POSITION"));
      const auto values = scene().values(primitive.attributes.at("POSITION"));
      for (size_t axis = 0; axis < 3; ++axis) {
        double low = values[axis], high = values[axis];
        for (size_t i = axis; i < values.size(); i += 3) {
          low = std::min(low, values[i]);
          high = std::max(high, values[i]);
        }
        EXPECT_EQ(positions.minValues.at(axis), low);
        EXPECT_EQ(positions.maxValues.at(axis), high);
      }
    }
  }
  for (const auto& sampler : model.animations.at(0).samplers) accessors.insert({sampler.input, sampler.output});
  for (const auto& node : model.nodes) meshes.insert(node.mesh);
  for (const auto& material : model.materials) {
    textures.insert({material.pbrMetallicRoughness.baseColorTexture.index, material.normalTexture.index,
                     material.pbrMetallicRoughness.metallicRoughnessTexture.index});
  }
  meshes.erase(-1);
  textures.erase(-1);
  EXPECT_EQ(accessors.size(), model.accessors.size());
  EXPECT_EQ(materials.size(), model.materials.size());
  EXPECT_EQ(meshes.size(), model.meshes.size());
  EXPECT_EQ(textures.size(), model.textures.size());
}

}  // namespace
}  // namespace lightloom::samples
