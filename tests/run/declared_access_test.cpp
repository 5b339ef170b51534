// What pass types declare against what their shaders do: every pass type that ships is clean, and each kind of mismatch
// is told with both places.
#include "framework/run/declared_access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/gpu/pipeline.hpp"
#include "framework/run/shader_folders.hpp"
#include "passes/registry.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Notes which shaders a pass asks for, and pretends that all is there, wanted and moving.
class NotingContext final : public PassContext {
 public:
  NotingContext(const ParamSet& params, bool kept) : params_(params), kept_(kept) {}
  const ParamSet& params() const override { return params_; }
  Extent3 input_extent(std::string_view) const override { return {8, 8, 8}; }
  Extent3 output_extent(std::string_view) const override { return {8, 8, 8}; }
  bool connected(std::string_view) const override { return true; }
  TriangleRange static_triangles() const override { return {0, 5}; }
  TriangleRange dynamic_triangles() const override { return {5, 3}; }
  std::vector<TriangleRange> triangles(TriangleKind) const override { return {{0, 8}}; }
  bool kept(std::string_view) const override { return kept_; }
  bool wanted(std::string_view) const override { return true; }
  std::vector<VoxelBox> moved_boxes(const Extent3&) const override { return {{{1, 1, 1}, {2, 2, 2}}}; }
  void clear(std::string_view, const ClearColor&) override {}
  void dispatch(const Dispatch& dispatch) override { programs.insert({dispatch.shader}); }
  void draw(const Draw& draw) override { programs.insert({draw.vertex_shader, draw.fragment_shader}); }

  std::set<std::vector<std::string>> programs;

 private:
  const ParamSet& params_;
  bool kept_ = false;
};

/// Every program that the type runs with its defaults, and with each choice of each param.
std::set<std::vector<std::string>> programs_of(const PassType& type) {
  std::set<std::vector<std::string>> programs;
  ParamSet params;
  for (const Param& param : type.params) params.set(param, param.default_value);
  const auto record = [&] {
    for (const bool kept : {false, true}) {
      NotingContext context(params, kept);
      type.record(context);
      programs.insert(context.programs.begin(), context.programs.end());
    }
  };
  record();
  for (const Param& param : type.params) {
    for (const std::string& choice : param.choices) {
      params.set(param, choice);
      record();
    }
    params.set(param, param.default_value);
  }
  return programs;
}

TEST(DeclaredAccess, EveryPassTypeThatShipsIsClean) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  const ShaderFolders folders = default_shader_folders();
  gpu::ShaderCompiler compiler({.include_directories = folders.sources, .cache_directory = folders.cache});
  std::set<std::string> seen;
  for (const std::string& name : registry.names()) {
    const PassType& type = *registry.find(name);
    if (type.host) continue;
    for (const std::vector<std::string>& files : programs_of(type)) {
      seen.insert(files.begin(), files.end());
      const gpu::Reflection reflection = gpu::reflect(compiler.compile_files(files));
      EXPECT_NO_THROW(require_declared_access(
          type, reflection, [&](std::string_view declared) { return compiler.declaration(files, declared); }));
    }
  }
  // What no pass runs: `lightloom brdf`, and the scans of values.
  seen.insert({"brdf.comp", "value_scan.comp"});
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "shaders")) {
    const bool known = entry.is_directory() || seen.contains(entry.path().filename().string());
    EXPECT_TRUE(known) << entry.path();
  }
}

/// A type with the input `value` and the output `value`, both r32_sfloat, and what each test makes of it.
struct Toy {
  PassType type = toy::one_shader_type(
      "toy", {toy::image_port("value", Direction::in), toy::image_port("value", Direction::out)}, "", "value");
  std::string input = "uniform texture2D value;";
  std::string output = "uniform writeonly image2D out_value;";
  std::string more;
  std::string body = "imageStore(out_value, ivec2(0), texelFetch(value, ivec2(0), 0));";

  /// What is wrong with the two; empty if nothing.
  [[nodiscard]] std::string problem() const {
    const std::string text = "#version 460\nlayout(local_size_x = 1) in;\n" + input + "\n" + output + "\n" + more +
                             "\nvoid main() { " + body + " }\n";
    gpu::ShaderCompiler compiler({});
    const gpu::ShaderSource source{.name = "toy.comp", .text = text, .stage = gpu::Stage::compute};
    const gpu::Reflection reflection = gpu::reflect(compiler.compile({&source, 1}));
    try {
      require_declared_access(type, reflection, [](std::string_view name) { return "PLACE of " + std::string(name); });
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::run_failed);
      EXPECT_NE(error.hint(), "");
      return error.what();
    }
    return {};
  }
};

TEST(DeclaredAccess, WhatFitsIsAccepted) {
  EXPECT_EQ(Toy{}.problem(), "");
  Toy loaded;
  loaded.type.ports[0].access = Access::compute_storage_read;
  loaded.input = "layout(r32f) uniform readonly image2D value;";
  loaded.body = "imageStore(out_value, ivec2(0), imageLoad(value, ivec2(0)));";
  EXPECT_EQ(loaded.problem(), "");
  Toy formatted;
  formatted.output = "layout(r32f) uniform image2D out_value;";
  EXPECT_EQ(formatted.problem(), "") << "not declared writeonly, but only written";
}

TEST(DeclaredAccess, AnInputMayNotBeWritten) {
  Toy toy;
  toy.input = "layout(r32f) uniform image2D value;";
  toy.body = "imageStore(value, ivec2(0), vec4(1)); imageStore(out_value, ivec2(0), vec4(1));";
  EXPECT_EQ(toy.problem(),
            "pass type 'toy': input 'value' is declared compute_sampled_read, 2D, r32_sfloat, but PLACE of value: "
            "'value' is a storage image that is written");
  toy.type.ports[0].access = Access::compute_storage_read;
  toy.body = "imageStore(out_value, ivec2(0), imageLoad(value, ivec2(0)));";
  EXPECT_THAT(toy.problem(), HasSubstr("'value' is a storage image that may be written"));
  toy.input = "layout(r32f) uniform readonly image2D value;";
  EXPECT_EQ(toy.problem(), "");
  toy.type.ports[0].access = Access::compute_sampled_read;
  EXPECT_THAT(toy.problem(), HasSubstr("'value' is a storage image"));
}

TEST(DeclaredAccess, AtomicsAreWrites) {
  Toy toy;
  toy.type.ports[0].access = Access::compute_storage_read;
  toy.type.ports[0].parts[0].format = Format::r32_uint;
  toy.input = "layout(r32ui) uniform uimage2D value;";
  toy.body = "imageAtomicMax(value, ivec2(0), 1u); imageStore(out_value, ivec2(0), vec4(1));";
  EXPECT_THAT(toy.problem(), HasSubstr("'value' is a storage image that is written"));
}

TEST(DeclaredAccess, ALoadedInputIsNoTexture) {
  Toy toy;
  toy.type.ports[0].access = Access::compute_storage_read;
  EXPECT_THAT(toy.problem(), AllOf(HasSubstr("declared compute_storage_read"), HasSubstr("'value' is a texture")));
}

TEST(DeclaredAccess, AnOutputThatIsOnlyWrittenMayNotBeRead) {
  Toy toy;
  toy.output = "layout(r32f) uniform image2D out_value;";
  toy.body += " imageStore(out_value, ivec2(0), imageLoad(out_value, ivec2(1)));";
  EXPECT_THAT(toy.problem(), HasSubstr("output 'value' is declared compute_storage_write, 2D, r32_sfloat, but PLACE of "
                                       "out_value: 'out_value' is read as well"));
  toy.type.ports[1].access = Access::compute_storage_read_write;
  EXPECT_EQ(toy.problem(), "");
}

TEST(DeclaredAccess, FormatsDimensionsAndNumbersAgree) {
  Toy format;
  format.output = "layout(rgba16f) uniform writeonly image2D out_value;";
  EXPECT_THAT(format.problem(), HasSubstr("'out_value' has the format rgba16_sfloat"));
  Toy numeric;
  numeric.type.ports[0].parts[0].format = Format::r32_uint;
  EXPECT_THAT(numeric.problem(), HasSubstr("'value' holds floating-point numbers"));
  Toy dimension;
  dimension.type.ports[0].dimension = Dimension::d3;
  EXPECT_THAT(dimension.problem(), AllOf(HasSubstr("compute_sampled_read, 3D"), HasSubstr("'value' is a single 2D")));
  Toy range;
  range.input = "uniform texture2DArray value;";
  range.body = "imageStore(out_value, ivec2(0), texelFetch(value, ivec3(0), 0));";
  EXPECT_THAT(range.problem(), HasSubstr("'value' is an array of images"));
  range.type.ports[0].array = true;
  EXPECT_EQ(range.problem(), "");
}

TEST(DeclaredAccess, TheStageIsTheAccesss) {
  Toy toy;
  toy.type.ports[0].access = Access::fragment_sampled_read;
  EXPECT_THAT(toy.problem(), HasSubstr("'value' is used in another stage of the pipeline"));
  toy.type.ports[0].access = Access::compute_sampled_read;
  toy.type.ports[1].access = Access::color_attachment_write;
  EXPECT_THAT(toy.problem(), HasSubstr("'out_value' is a storage image"));
}

TEST(DeclaredAccess, ConstantsHoldTheirParams) {
  const auto with = [](ParamType type, const ParamValue& value, const std::string& glsl) {
    Toy toy;
    toy.type.params = {{"amount", type, value, {}, {}, {"a", "b"}, "", ""}};
    toy.more = "layout(push_constant) uniform Params { " + glsl + " amount; };";
    toy.body = "imageStore(out_value, ivec2(0), texelFetch(value, ivec2(0), 0) * float(amount));";
    return toy.problem();
  };
  EXPECT_EQ(with(ParamType::real, 0.5, "float"), "");
  EXPECT_EQ(with(ParamType::integer, int64_t{1}, "int"), "");
  EXPECT_EQ(with(ParamType::choice, std::string("a"), "uint"), "");
  EXPECT_EQ(with(ParamType::boolean, true, "uint"), "");
  EXPECT_EQ(with(ParamType::real, 0.5, "int"),
            "pass type 'toy': param 'amount' is a real number, but PLACE of amount: 'amount' is of type int");
  EXPECT_THAT(with(ParamType::integer, int64_t{1}, "float"), HasSubstr("param 'amount' is an integer"));
  EXPECT_THAT(with(ParamType::integer, int64_t{1}, "uint"), HasSubstr("an integer that may be negative"));
  EXPECT_THAT(with(ParamType::choice, std::string("a"), "float"), HasSubstr("param 'amount' is a choice"));
}

class DeclaredAccessRun : public test::DeviceTest {};

TEST_F(DeclaredAccessRun, AnOutputThatNothingWritesIsNamed) {
  PassType type =
      toy::one_shader_type("half_done", {toy::image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp");
  type.ports.push_back(toy::image_port("forgotten", Direction::out));
  test::GraphRunOptions options;
  options.extra_types = {type};
  const std::string graph = R"({ "lightloom": 1, "trace": { "width": 8, "height": 8 },
    "passes": { "a": { "type": "half_done" } }, "outputs": { "image": "a.OUTPUT" } })";
  const auto of = [&](const std::string& output) {
    std::string text = graph;
    return text.replace(text.find("OUTPUT"), 6, output);
  };
  EXPECT_NO_THROW((void)test::run_graph(of("ramp"), toy::one_quad(), options)) << "nobody reads the other";
  try {
    (void)test::run_graph(of("forgotten"), toy::one_quad(), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "pass 'a' (half_done) recorded nothing that writes its output 'forgotten'");
  }
}

TEST_F(DeclaredAccessRun, TheLineOfTheShaderIsNamed) {
  PassType type = toy::one_shader_type("wrong", {toy::image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp");
  type.ports[0].parts[0].format = Format::r32_uint;
  test::GraphRunOptions options;
  options.extra_types = {type};
  try {
    (void)test::run_graph(R"({ "lightloom": 1, "trace": { "width": 8, "height": 8 },
      "passes": { "a": { "type": "wrong" } }, "outputs": { "image": "a.ramp" } })",
                          toy::one_quad(), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::ContainsRegex("test_ramp.comp:[0-9]+: 'out_ramp' holds floating-point numbers"));
  }
}

}  // namespace
}  // namespace lightloom::run
