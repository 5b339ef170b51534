#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "framework/scene/basis.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::GltfBuilder;

glm::vec3 face_normal(const Scene& scene, size_t t) {
  const Triangle& triangle = scene.triangles[t];
  return glm::vec3(glm::normalize(double_area(scene.vertices[triangle.a].position, scene.vertices[triangle.b].position,
                                              scene.vertices[triangle.c].position)));
}

TEST(Geometry, UprightQuadHasTangentAlongUAndPositiveBitangentSign) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  const Scene scene = builder.load();
  ASSERT_EQ(scene.triangles.size(), 2u);
  for (const Vertex& vertex : scene.vertices) {
    EXPECT_NEAR(glm::distance(glm::vec3(vertex.tangent), glm::vec3(1, 0, 0)), 0, 1e-6);
    EXPECT_EQ(vertex.tangent.w, 1.0f) << "the bitangent points up, against v";
  }
}

TEST(Geometry, NegativeScaleKeepsFacesOutwardAndFlipsTheBitangentSign) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}, {"scale", {-2, 1, 1}}});
  const Scene scene = builder.load();
  for (size_t t = 0; t < scene.triangles.size(); ++t) EXPECT_GT(face_normal(scene, t).z, 0.999f);
  for (const Vertex& vertex : scene.vertices) {
    EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
    EXPECT_NEAR(vertex.tangent.x, -1, 1e-6);
    EXPECT_EQ(vertex.tangent.w, -1.0f);
    // The bitangent must still be the image of the original one, +y.
    EXPECT_NEAR((glm::cross(vertex.normal, glm::vec3(vertex.tangent)) * vertex.tangent.w).y, 1, 1e-6);
  }
}

TEST(Geometry, NormalsUseTheInverseTranspose) {
  GltfBuilder builder;
  const int positions = builder.accessor<float>({1, 0, 0, 0, 1, 0, 0, 1, 1}, "VEC3");
  const int mesh = builder.mesh({{"POSITION", positions}});
  builder.node({{"mesh", mesh}, {"scale", {4, 1, 0.5}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}});
  const Scene scene = builder.load();
  EXPECT_NEAR(glm::distance(scene.vertices[0].normal, face_normal(scene, 0)), 0, 1e-5);
}

TEST(Geometry, MirroredTextureSeamSplitsVertices) {
  GltfBuilder builder;
  // Two quads side by side that share an edge; u runs 0 to 1 on the left and back to 0 on the right.
  const int positions = builder.accessor<float>({-1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  const int normals = builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int texcoords = builder.accessor<float>({0, 1, 1, 1, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC2");
  const int indices = builder.accessor<uint8_t>({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}, "SCALAR");
  builder.node(
      {{"mesh", builder.mesh({{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}}, indices)}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.vertices.size(), 8u);
  for (const Triangle& triangle : scene.triangles) {
    const bool left = scene.vertices[triangle.a].position.x + scene.vertices[triangle.b].position.x +
                          scene.vertices[triangle.c].position.x <
                      0;
    for (const uint32_t corner : {triangle.a, triangle.b, triangle.c}) {
      EXPECT_NEAR(scene.vertices[corner].tangent.x, left ? 1 : -1, 1e-6);
      EXPECT_EQ(scene.vertices[corner].tangent.w, left ? 1.0f : -1.0f);
    }
  }
}

TEST(Geometry, DegenerateTexcoordsStillGiveOrthonormalFrames) {
  GltfBuilder builder;
  const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int texcoords = builder.accessor<float>({0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, "VEC2");
  builder.node({{"mesh", builder.mesh({{"POSITION", positions}, {"TEXCOORD_0", texcoords}})}});
  for (const Vertex& vertex : builder.load().vertices) {
    EXPECT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-6);
    EXPECT_NEAR(glm::dot(glm::vec3(vertex.tangent), vertex.normal), 0, 1e-6);
  }
}

TEST(Geometry, AnyTangentIsOrthonormalInAllDirections) {
  for (int i = 0; i < 2000; ++i) {
    const double z = 1 - 2 * (i + 0.5) / 2000, azimuth = i * 2.399963229728653;
    const double r = std::sqrt(1 - z * z);
    const glm::vec3 normal(glm::dvec3(r * std::cos(azimuth), r * std::sin(azimuth), z));
    const glm::vec3 tangent = any_tangent(normal);
    ASSERT_NEAR(glm::length(tangent), 1, 1e-5);
    ASSERT_NEAR(glm::dot(tangent, normal), 0, 1e-5);
  }
  for (const glm::vec3 axis : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(0, -1, 0)}) {
    EXPECT_NEAR(glm::dot(any_tangent(axis), axis), 0, 1e-6);
  }
}

TEST(Geometry, StripsAndFansBecomeTrianglesOfEqualFacing) {
  for (const int mode : {5, 6}) {
    SCOPED_TRACE(mode);
    GltfBuilder builder;
    const int positions = mode == 5 ? builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3")
                                    : builder.accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0}, "VEC3");
    builder.append("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}}});
    builder.node({{"mesh", 0}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 3u);
    double area = 0;
    for (size_t t = 0; t < 3; ++t) {
      EXPECT_GT(face_normal(scene, t).z, 0.999f);
      const Triangle& triangle = scene.triangles[t];
      area += glm::length(double_area(scene.vertices[triangle.a].position, scene.vertices[triangle.b].position,
                                      scene.vertices[triangle.c].position)) /
              2;
    }
    EXPECT_NEAR(area, 1.5, 1e-6);
  }
}

TEST(Geometry, PointsAndLinesAreSkippedWithAWarning) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  builder.append(
      "meshes",
      {{"primitives",
        {{{"attributes", {{"POSITION", 0}}}, {"mode", 0}}, {{"attributes", {{"POSITION", 0}}}, {"mode", 3}}}}});
  builder.node({{"mesh", 1}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.triangles.size(), 2u);
  size_t found = 0;
  for (const std::string& warning : scene.warnings)
    found += warning.find("points or lines") != std::string::npos ? 1u : 0u;
  EXPECT_EQ(found, 2u);
}

TEST(Geometry, DegenerateTrianglesAreDroppedAndCounted) {
  GltfBuilder builder;
  const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0}, "VEC3");
  const int indices = builder.accessor<uint32_t>({0, 1, 2, 0, 1, 3, 1, 1, 2}, "SCALAR");
  builder.node({{"mesh", builder.mesh({{"POSITION", positions}}, indices)}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.triangles.size(), 1u);
  EXPECT_TRUE(std::any_of(scene.warnings.begin(), scene.warnings.end(),
                          [](const std::string& w) { return w == "2 degenerate triangles were dropped"; }));
}

TEST(Geometry, QuantizedAttributesAreDecoded) {
  GltfBuilder builder;
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const int positions = builder.accessor<int16_t>({-32767, 0, 0, 32767, 0, 0, 0, 32767, 0}, "VEC3", true);
  builder.json["bufferViews"][0]["byteStride"] = 8;
  // Three 6-byte elements do not fit a stride of 8 in 18 bytes, so the data is written again with padding.
  const int view = builder.buffer_view<int16_t>({-32767, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0});
  builder.json["bufferViews"][view]["byteStride"] = 8;
  builder.json["accessors"][positions]["bufferView"] = view;
  const int normals = builder.accessor<int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, "VEC4", true);
  builder.json["accessors"][normals]["type"] = "VEC3";
  builder.json["bufferViews"][builder.json["accessors"][normals]["bufferView"].get<int>()]["byteStride"] = 4;
  const int texcoords = builder.accessor<uint16_t>({0, 65535, 65535, 0, 32768, 0}, "VEC2", true);
  const int colors = builder.accessor<uint8_t>({255, 0, 128, 255, 1, 2, 3, 4, 0, 0, 0, 0}, "VEC4", true);
  builder.node(
      {{"mesh",
        builder.mesh({{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}, {"COLOR_0", colors}})}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.vertices[0].position, glm::vec3(-1, 0, 0));
  EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.vertices[0].normal, glm::vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(scene.vertices[0].v0, 1.0f);
  EXPECT_FLOAT_EQ(scene.vertices[2].u0, 32768.0f / 65535.0f);
  EXPECT_EQ(scene.vertices[0].color, 0xFF8000FFu);
  EXPECT_EQ(scene.vertices[1].color, 0x04030201u);
}

TEST(Geometry, SparseAccessorsReplaceElements) {
  GltfBuilder builder;
  const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int indices = builder.buffer_view<uint16_t>({1});
  const int values = builder.buffer_view<float>({5, 0, 0});
  builder.json["accessors"][positions]["sparse"] = {{"count", 1},
                                                    {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                    {"values", {{"bufferView", values}}}};
  builder.node({{"mesh", builder.mesh({{"POSITION", positions}})}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.vertices[1].position, glm::vec3(5, 0, 0));
  EXPECT_EQ(scene.vertices[2].position, glm::vec3(0, 1, 0));
}

TEST(Geometry, ObjectsFollowTheDepthFirstOrderOfNodes) {
  GltfBuilder builder;
  const int quad = builder.quad();
  builder.node({{"name", "second"}, {"mesh", quad}, {"translation", {0, 0, 2}}});
  builder.node({{"name", "first"}, {"mesh", quad}, {"children", {2}}, {"translation", {0, 0, 5}}});
  builder.node({{"name", "child"}, {"mesh", quad}, {"translation", {0, 0, 1}}});
  builder.json["scenes"] = {{{"nodes", {1, 0}}}};
  const Scene scene = builder.load();
  EXPECT_EQ(scene.objects, (std::vector<std::string>{"first", "child", "second"}));
  EXPECT_EQ(scene.triangles[0].object, 0u);
  EXPECT_EQ(scene.vertices[scene.triangles[2].a].position.z, 6);
  EXPECT_EQ(scene.vertices[scene.triangles[4].a].position.z, 2);
}

TEST(Geometry, FlattenedMeshKeepsItsPlaneNormal) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}, {"scale", {1, 1, 0}}});
  const Scene scene = builder.load();
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.vertices[0].normal, glm::vec3(0, 0, 1));
  EXPECT_LT(scene.bounds.min.z, scene.bounds.max.z) << "a flat scene gets a thickness";
}

}  // namespace
}  // namespace lightloom::scene
