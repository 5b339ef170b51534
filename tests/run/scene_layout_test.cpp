#include "framework/run/scene_layout.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>

#include "framework/gpu/reflection.hpp"
#include "framework/gpu/shader_compiler.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/scene/gpu_material.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {
namespace {

/// Offset and size of every member, nested ones by "outer.inner", and the stride of arrays by "name[]".
void flatten(const std::vector<gpu::BlockMember>& members, const std::string& prefix,
             std::map<std::string, uint32_t>& offsets) {
  for (const gpu::BlockMember& member : members) {
    offsets[prefix + member.name] = member.offset;
    if (member.array) offsets[prefix + member.name + "[]"] = member.array_stride;
    flatten(member.members, prefix + member.name + ".", offsets);
  }
}

class SceneLayout : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    constexpr const char* kUser = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/scene.glsl"
layout(local_size_x = 1) in;
layout(std430) writeonly buffer ResultBlock { float result; };
void main() {
  result = frame.counts.x + vertex_at(0).position.x + triangle_at(0).object + materials[0].flags.w +
           lights.emissions[1].sides.x + lights.emitters[1].surface.x + lights.hints[1].normal.x + lights.punctual[1].cone.x + past_positions[1].x;
})";
    const gpu::ShaderSource source{"user.comp", kUser, gpu::Stage::compute};
    gpu::ShaderCompiler compiler({.include_directories = default_shader_folders().sources, .cache_directory = {}});
    reflection = gpu::reflect(compiler.compile(std::span(&source, 1)));
  }
  static std::map<std::string, uint32_t> offsets(const std::string& block) {
    std::map<std::string, uint32_t> result;
    const gpu::Binding* binding = reflection.find_binding(block);
    if (binding != nullptr) flatten(binding->members, "", result);
    return result;
  }
  static inline gpu::Reflection reflection;
};

TEST_F(SceneLayout, FrameBlock) {
  const std::map<std::string, uint32_t> expected = {
      {"view_projection", offsetof(FrameBlock, view_projection)},
      {"view_projection[]", sizeof(glm::mat4)},
      {"eye", offsetof(FrameBlock, eye)},
      {"eye[]", sizeof(glm::vec4)},
      {"inverse_view_projection", offsetof(FrameBlock, inverse_view_projection)},
      {"ids", offsetof(FrameBlock, ids)},
      {"scene_min", offsetof(FrameBlock, scene_min)},
      {"scene_max", offsetof(FrameBlock, scene_max)},
      {"sun_direction", offsetof(FrameBlock, sun_direction)},
      {"sun_irradiance", offsetof(FrameBlock, sun_irradiance)},
      {"environment", offsetof(FrameBlock, environment)},
      {"counts", offsetof(FrameBlock, counts)},
      {"motion", offsetof(FrameBlock, motion)},
  };
  EXPECT_EQ(offsets("FrameBlock"), expected);
  EXPECT_EQ(reflection.find_binding("FrameBlock")->block_size, sizeof(FrameBlock));
}

TEST_F(SceneLayout, LightBlock) {
  const auto found = offsets("LightBlock");
  EXPECT_EQ(found.at("emissions"), offsetof(LightBlock, emissions));
  EXPECT_EQ(found.at("emissions[]"), sizeof(EmissionEntry));
  EXPECT_EQ(found.at("emitters"), offsetof(LightBlock, emitters));
  EXPECT_EQ(found.at("emitters[]"), sizeof(EmitterEntry));
  EXPECT_EQ(found.at("hints"), offsetof(LightBlock, hints));
  EXPECT_EQ(found.at("hints[]"), sizeof(HintEntry));
  EXPECT_EQ(found.at("punctual"), offsetof(LightBlock, punctual));
  EXPECT_EQ(found.at("punctual[]"), sizeof(PunctualEntry));
  EXPECT_EQ(found.at("punctual.cone"), offsetof(PunctualEntry, cone));
  EXPECT_EQ(reflection.find_binding("LightBlock")->block_size, sizeof(LightBlock));
}

TEST_F(SceneLayout, VerticesAndTriangles) {
  const auto vertex = offsets("VertexBlock");
  EXPECT_EQ(vertex.at("vertices[]"), sizeof(scene::Vertex));
  EXPECT_EQ(vertex.at("vertices.u0"), offsetof(scene::Vertex, u0));
  EXPECT_EQ(vertex.at("vertices.nx"), offsetof(scene::Vertex, normal));
  EXPECT_EQ(vertex.at("vertices.tx"), offsetof(scene::Vertex, tangent));
  EXPECT_EQ(vertex.at("vertices.u1"), offsetof(scene::Vertex, uv1));
  EXPECT_EQ(vertex.at("vertices.color"), offsetof(scene::Vertex, color));
  const auto triangle = offsets("TriangleBlock");
  EXPECT_EQ(triangle.at("triangles[]"), sizeof(scene::Triangle));
  EXPECT_EQ(triangle.at("triangles.material"), offsetof(scene::Triangle, material));
  EXPECT_EQ(triangle.at("triangles.object"), offsetof(scene::Triangle, object));
  EXPECT_EQ(reflection.find_binding("VertexBlock")->count, kGeometryPieces);
  EXPECT_EQ(reflection.find_binding("TriangleBlock")->count, kGeometryPieces);
}

TEST_F(SceneLayout, PastPositions) {
  EXPECT_EQ(offsets("PastPositionBlock").at("past_positions[]"), sizeof(glm::vec4));
}

TEST_F(SceneLayout, Materials) {
  EXPECT_EQ(offsets("MaterialBlock").at("materials[]"), sizeof(scene::GpuMaterial));
}

}  // namespace
}  // namespace lightloom::run
