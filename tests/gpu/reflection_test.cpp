#include "framework/gpu/reflection.hpp"

#include <array>

#include "framework/gpu/pipeline.hpp"
#include "tests/gpu/gpu_support.hpp"

namespace lightloom::gpu {
namespace {

using test::compile_compute;
using test::compile_program;
using test::error_of;
using ::testing::HasSubstr;

const char* const kEverything = R"(
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(constant_id = 7) const bool has_sun = false;
layout(constant_id = 3) const int radius = 4;
layout(constant_id = 5) const uint mode = 1u;
layout(constant_id = 4) const float scale = 0.5;
const uint kPages = 3u;
struct Light { vec4 position; vec3 color; float range; };
layout(std140) uniform FrameBlock { mat4 matrices[4]; uvec4 ids; Light lights[2]; } frame;
struct Item { float x, y; uint id; };
layout(std430) readonly buffer ItemBlock { uint count; Item items[]; };
layout(std430) buffer LogBlock { uint log[]; };
layout(push_constant) uniform Push { uint axis; float exposure; int offset; bool flip; } push;
uniform texture2D albedo;
uniform utexture2D ids;
uniform texture2DArray trail;
uniform texture3D voxels;
uniform sampler2DArray pages[kPages];
uniform sampler nearest;
layout(r32ui) uniform uimage2D counter;
writeonly uniform image3D out_voxels;
layout(rgba16f) readonly uniform image2D previous;
uniform texture2D unused;
layout(std140) uniform UnusedBlock { vec4 nothing; };
void main() {
  ivec3 p = ivec3(gl_GlobalInvocationID);
  vec4 sum = texelFetch(albedo, p.xy, 0) + texelFetch(trail, p, 0) + texelFetch(voxels, p, 0);
  sum += textureLod(pages[0], vec3(p), 0.0) + textureLod(pages[2], vec3(p), 0.0);
  sum += texelFetch(sampler2D(albedo, nearest), p.xy, 0) + imageLoad(previous, p.xy);
  sum += frame.matrices[1] * frame.lights[1].position + vec4(items[count].y) * scale * push.exposure;
  if (has_sun && push.flip) sum += vec4(float(radius) + float(mode));
  log[p.x] = texelFetch(ids, p.xy, 0).x + frame.ids.x + push.axis + uint(push.offset);
  imageAtomicAdd(counter, p.xy, 1u);
  imageStore(out_voxels, p, sum);
}
)";

class ReflectionTest : public ::testing::Test {
 protected:
  [[nodiscard]] static const Reflection& reflection() {
    static const ShaderProgram program = compile_compute(kEverything);
    return program.reflection;
  }
  [[nodiscard]] static const Binding& binding(const std::string& name) {
    const Binding* found = reflection().find_binding(name);
    if (found == nullptr) throw Error(ExitCode::run_failed, "no binding " + name);
    return *found;
  }
};

TEST_F(ReflectionTest, KnowsKindsShapesAndNumericClasses) {
  struct Row {
    const char* name;
    BindingKind kind;
    ImageShape shape;
    NumericClass numeric;
    uint32_t count;
  };
  const std::array rows{
      Row{"albedo", BindingKind::sampled_image, ImageShape::d2, NumericClass::floating, 1},
      Row{"ids", BindingKind::sampled_image, ImageShape::d2, NumericClass::unsigned_integer, 1},
      Row{"trail", BindingKind::sampled_image, ImageShape::d2_array, NumericClass::floating, 1},
      Row{"voxels", BindingKind::sampled_image, ImageShape::d3, NumericClass::floating, 1},
      Row{"pages", BindingKind::combined_sampler, ImageShape::d2_array, NumericClass::floating, 3},
      Row{"counter", BindingKind::storage_image, ImageShape::d2, NumericClass::unsigned_integer, 1},
      Row{"out_voxels", BindingKind::storage_image, ImageShape::d3, NumericClass::floating, 1},
      Row{"previous", BindingKind::storage_image, ImageShape::d2, NumericClass::floating, 1},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(binding(row.name).kind, row.kind) << row.name;
    EXPECT_EQ(binding(row.name).shape, row.shape) << row.name;
    EXPECT_EQ(binding(row.name).numeric, row.numeric) << row.name;
    EXPECT_EQ(binding(row.name).count, row.count) << row.name;
    EXPECT_EQ(binding(row.name).stages, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_COMPUTE_BIT)) << row.name;
  }
  EXPECT_EQ(binding("nearest").kind, BindingKind::sampler);
  EXPECT_EQ(binding("FrameBlock").kind, BindingKind::uniform_buffer);
  EXPECT_EQ(binding("ItemBlock").kind, BindingKind::storage_buffer);
}

TEST_F(ReflectionTest, LeavesOutWhatIsNotUsed) {
  EXPECT_EQ(reflection().find_binding("unused"), nullptr);
  EXPECT_EQ(reflection().find_binding("UnusedBlock"), nullptr);
  EXPECT_EQ(reflection().bindings.size(), 12u);
}

TEST_F(ReflectionTest, KnowsWhichMembersOfABlockAreUsed) {
  for (const BlockMember& member : binding("FrameBlock").members) EXPECT_TRUE(member.used) << member.name;
  const ShaderProgram program = compile_compute(R"(
layout(local_size_x = 1) in;
layout(constant_id = 0) const bool other = false;
layout(std140) uniform Block { mat4 matrices[4]; uvec4 ids; vec4 a; vec4 b; vec4 c; } block;
layout(std430) buffer LogBlock { vec4 log[]; };
vec4 helper(uint i) { return block.matrices[i][1]; }
vec4 dead() { return block.c; }
void main() {
  log[0] = helper(gl_GlobalInvocationID.x);
  if (other) log[0].x += float(block.ids.z);
  else log[0].y = block.a.w;
})");
  for (const BlockMember& member : program.reflection.find_binding("Block")->members)
    EXPECT_EQ(member.used, member.name != "b" && member.name != "c") << member.name;
}

TEST_F(ReflectionTest, GivesEachResourceItsOwnBindingInSet0) {
  uint32_t next_free = 0;
  for (const Binding& one : reflection().bindings) {
    EXPECT_EQ(one.set, 0u);
    EXPECT_GE(one.binding, next_free) << one.name;
    next_free = one.binding + 1;
  }
}

TEST_F(ReflectionTest, KnowsWhatIsReadAndWritten) {
  const auto access = [](const char* name) { return std::pair(binding(name).readable, binding(name).writable); };
  EXPECT_EQ(access("counter"), std::pair(true, true));
  EXPECT_EQ(access("out_voxels"), std::pair(false, true));
  EXPECT_EQ(access("previous"), std::pair(true, false));
  EXPECT_EQ(access("ItemBlock"), std::pair(true, false));
  EXPECT_EQ(access("LogBlock"), std::pair(true, true));
  EXPECT_EQ(access("albedo"), std::pair(true, false));
  EXPECT_EQ(access("FrameBlock"), std::pair(true, false));
}

// Offsets by the rules of std140 (OpenGL 4.6 specification, 7.6.2.2), worked out by hand.
TEST_F(ReflectionTest, KnowsTheLayoutOfAUniformBlock) {
  const Binding& frame = binding("FrameBlock");
  EXPECT_EQ(frame.block_size, 4u * 64 + 16 + 2 * 32);
  ASSERT_EQ(frame.members.size(), 3u);
  const BlockMember& matrices = frame.members[0];
  EXPECT_EQ(matrices.name, "matrices");
  EXPECT_EQ(matrices.size, 256u);
  EXPECT_EQ(matrices.columns, 4u);
  EXPECT_EQ(matrices.components, 4u);
  EXPECT_EQ(matrices.array_count, 4u);
  EXPECT_EQ(matrices.array_stride, 64u);
  EXPECT_EQ(frame.members[1].offset, 256u);
  EXPECT_EQ(frame.members[1].type, ScalarType::uint32);
  const BlockMember& lights = frame.members[2];
  EXPECT_EQ(lights.offset, 272u);
  EXPECT_EQ(lights.array_count, 2u);
  EXPECT_EQ(lights.array_stride, 32u);
  ASSERT_EQ(lights.members.size(), 3u);
  EXPECT_EQ(lights.members[1].name, "color");
  EXPECT_EQ(lights.members[1].offset, 16u);
  EXPECT_EQ(lights.members[1].components, 3u);
  EXPECT_EQ(lights.members[2].offset, 28u);
}

TEST_F(ReflectionTest, KnowsTheLayoutOfARuntimeArray) {
  const Binding& items = binding("ItemBlock");
  EXPECT_EQ(items.block_size, 4u);
  ASSERT_EQ(items.members.size(), 2u);
  EXPECT_TRUE(items.members[1].array);
  EXPECT_EQ(items.members[1].array_count, 0u);
  EXPECT_EQ(items.members[1].array_stride, 12u);
  EXPECT_EQ(items.members[1].members.at(2).name, "id");
  EXPECT_EQ(items.members[1].members.at(2).offset, 8u);
}

TEST_F(ReflectionTest, KnowsPushConstants) {
  ASSERT_EQ(reflection().push_constants.size(), 4u);
  EXPECT_EQ(reflection().push_constant_size, 16u);
  const std::array<std::pair<const char*, ScalarType>, 4> expected{{{"axis", ScalarType::uint32},
                                                                    {"exposure", ScalarType::float32},
                                                                    {"offset", ScalarType::int32},
                                                                    {"flip", ScalarType::uint32}}};
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(reflection().push_constants[i].name, expected[i].first);
    EXPECT_EQ(reflection().push_constants[i].type, expected[i].second);
    EXPECT_EQ(reflection().push_constants[i].offset, i * 4);
    EXPECT_EQ(reflection().push_constants[i].size, 4u);
  }
}

TEST_F(ReflectionTest, KnowsSpecializationConstants) {
  ASSERT_EQ(reflection().constants.size(), 4u);
  const std::array<std::tuple<const char*, uint32_t, ScalarType>, 4> expected{{{"radius", 3, ScalarType::int32},
                                                                               {"scale", 4, ScalarType::float32},
                                                                               {"mode", 5, ScalarType::uint32},
                                                                               {"has_sun", 7, ScalarType::boolean}}};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(reflection().constants[i].name, std::get<0>(expected[i]));
    EXPECT_EQ(reflection().constants[i].id, std::get<1>(expected[i]));
    EXPECT_EQ(reflection().constants[i].type, std::get<2>(expected[i]));
  }
}

TEST_F(ReflectionTest, KnowsTheLocalSize) {
  EXPECT_EQ(reflection().local_size, (std::array<uint32_t, 3>{8, 4, 2}));
}

TEST_F(ReflectionTest, ExplicitBindingsGiveWayToNames) {
  const ShaderProgram program = compile_compute(R"(
layout(local_size_x = 1) in;
layout(set = 2, binding = 9) uniform texture2D a;
layout(binding = 9, rgba8) writeonly uniform image2D b;
void main() { imageStore(b, ivec2(0), texelFetch(a, ivec2(0), 0)); }
)");
  ASSERT_EQ(program.reflection.bindings.size(), 2u);
  EXPECT_EQ(program.reflection.bindings[0].set, 0u);
  EXPECT_NE(program.reflection.bindings[0].binding, program.reflection.bindings[1].binding);
}

TEST_F(ReflectionTest, AnArrayOfSpecializedLengthIsAnError) {
  EXPECT_THAT(error_of([] {
                static_cast<void>(compile_compute(R"(
layout(local_size_x = 1) in;
layout(constant_id = 0) const int count = 2;
uniform sampler2D pages[count];
layout(std430) buffer R { vec4 r; };
void main() { r = textureLod(pages[1], vec2(0), 0.0); }
)"));
              }).what(),
              HasSubstr("'pages'"));
}

TEST_F(ReflectionTest, AnArrayOfBlocksHasTheMembersOfOne) {
  const ShaderProgram program = compile_compute(R"(
layout(std430) readonly buffer NumberBlock { uint first; vec2 numbers[]; } pieces[3];
layout(std430) buffer R { vec2 r; };
void main() { r = pieces[0].numbers[1] + pieces[2].numbers[0]; }
)");
  const Binding* binding = program.reflection.find_binding("NumberBlock");
  ASSERT_NE(binding, nullptr);
  EXPECT_EQ(binding->count, 3u);
  ASSERT_EQ(binding->members.size(), 2u);
  EXPECT_EQ(binding->members[1].offset, 8u);
  EXPECT_EQ(binding->members[1].array_stride, 8u);
  EXPECT_FALSE(binding->writable);
}

const char* const kVertex = R"(
layout(std140) uniform FrameBlock { mat4 matrix; } frame;
layout(std430) readonly buffer VertexBlock { vec4 vertices[]; };
layout(push_constant) uniform Push { uint first; float bias; } push;
layout(constant_id = 1) const bool shared_constant = false;
layout(constant_id = 2) const float only_vertex = 1.0;
out vec3 normal;
out vec2 uv;
flat out uint id;
void main() {
  normal = vec3(only_vertex);
  uv = vec2(shared_constant ? 1.0 : 0.0);
  id = push.first;
  gl_Position = frame.matrix * vertices[gl_VertexIndex];
}
)";
const char* const kFragment = R"(
uniform texture2D albedo;
layout(push_constant) uniform Push { uint first; float bias; } push;
layout(std140) uniform FrameBlock { mat4 matrix; } frame;
layout(constant_id = 1) const bool shared_constant = false;
layout(constant_id = 3) const float only_fragment = 1.0;
flat in uint id;
in vec2 uv;
in vec3 normal;
out uvec2 out_surface_id;
out vec4 out_surface_normal;
void main() {
  out_surface_id = uvec2(id, shared_constant ? 1u : 0u);
  out_surface_normal = vec4(normal, push.bias) * frame.matrix[0] * only_fragment + texelFetch(albedo, ivec2(uv), 0);
}
)";

TEST(GraphicsReflection, StagesShareNames) {
  const ShaderProgram program =
      compile_program({{"a.vert", kVertex, Stage::vertex}, {"a.frag", kFragment, Stage::fragment}});
  const Reflection& reflection = program.reflection;
  EXPECT_EQ(reflection.name, "a.vert + a.frag");
  EXPECT_EQ(reflection.bindings.size(), 3u);
  constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  EXPECT_EQ(reflection.find_binding("FrameBlock")->stages, kBoth);
  EXPECT_EQ(reflection.find_binding("VertexBlock")->stages,
            static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_VERTEX_BIT));
  EXPECT_EQ(reflection.find_binding("albedo")->stages, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_FRAGMENT_BIT));
  EXPECT_EQ(reflection.push_constant_stages, kBoth);
  EXPECT_EQ(reflection.constants.size(), 3u);
  EXPECT_EQ(reflection.find_constant("shared_constant")->stages, kBoth);
  ASSERT_EQ(reflection.outputs.size(), 2u);
  for (const FragmentOutput& output : reflection.outputs) {
    EXPECT_EQ(output.numeric,
              output.name == "out_surface_id" ? NumericClass::unsigned_integer : NumericClass::floating);
  }
  EXPECT_NE(reflection.outputs[0].location, reflection.outputs[1].location);
}

TEST(GraphicsReflection, ExplicitOutputLocationsAreKept) {
  const ShaderProgram program =
      compile_program({{"a.vert", "void main() { gl_Position = vec4(0); }", Stage::vertex},
                       {"a.frag",
                        "out vec4 free;\nlayout(location = 0) out vec4 zero;\nlayout(location = 2) out vec4 two;\n"
                        "void main() { free = vec4(1); zero = vec4(2); two = vec4(3); }",
                        Stage::fragment}});
  ASSERT_EQ(program.reflection.outputs.size(), 3u);
  EXPECT_EQ(program.reflection.outputs[0].name, "zero");
  EXPECT_EQ(program.reflection.outputs[1].name, "free");
  EXPECT_EQ(program.reflection.outputs[2].name, "two");
}

TEST(GraphicsReflection, PushConstantsThatLieOnEachOtherAreAnError) {
  EXPECT_THAT(
      error_of([] {
        static_cast<void>(compile_program(
            {{"a.vert", "layout(push_constant) uniform P { uint a; } p;\nvoid main() { gl_Position = vec4(p.a); }",
              Stage::vertex},
             {"a.frag", "layout(push_constant) uniform Q { uint b; } q;\nout vec4 o;\nvoid main() { o = vec4(q.b); }",
              Stage::fragment}}));
      }).what(),
      HasSubstr("a.vert + a.frag"));
}

TEST(GraphicsReflection, ANameWithTwoMeaningsIsAnError) {
  EXPECT_THAT(error_of([] {
                static_cast<void>(compile_program(
                    {{"a.vert", "uniform texture3D t;\nvoid main() { gl_Position = texelFetch(t, ivec3(0), 0); }",
                      Stage::vertex},
                     {"a.frag", "uniform texture2D t;\nout vec4 o;\nvoid main() { o = texelFetch(t, ivec2(0), 0); }",
                      Stage::fragment}}));
              }).what(),
              HasSubstr("a.vert + a.frag"));
}

TEST(Reflection, WhatIsNoSpirvIsAnError) {
  const SpirvModule module{.name = "nonsense", .stage = Stage::compute, .words = {1, 2, 3}};
  EXPECT_THAT(error_of([&] { static_cast<void>(reflect(std::span(&module, 1))); }).what(), HasSubstr("nonsense"));
}

TEST(RayQueryReflection, AccelerationStructureIsABindingOfItsOwnKind) {
  const ShaderProgram program = compile_compute(R"(
#extension GL_EXT_ray_query : require
layout(local_size_x = 8) in;
uniform accelerationStructureEXT scene_tlas;
layout(std430) buffer HitBlock { float hits[]; };
void main() {
  rayQueryEXT query;
  rayQueryInitializeEXT(query, scene_tlas, gl_RayFlagsOpaqueEXT, 0xFFu, vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), 1e30);
  while (rayQueryProceedEXT(query)) {}
  hits[gl_GlobalInvocationID.x] = rayQueryGetIntersectionTEXT(query, true);
}
)");
  const Binding* binding = program.reflection.find_binding("scene_tlas");
  ASSERT_NE(binding, nullptr);
  EXPECT_EQ(binding->kind, BindingKind::acceleration_structure);
  EXPECT_EQ(binding->count, 1u);
  EXPECT_EQ(to_string(binding->kind), "acceleration structure");
}

}  // namespace
}  // namespace lightloom::gpu
