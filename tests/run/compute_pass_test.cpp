// The pass type `compute`: what follows from the shader and the node, and that it runs like any other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run/compute_support.hpp"

namespace lightloom::run {
namespace {

using testing::HasSubstr;

constexpr const char* kOutput = "uniform writeonly image2D out_value;";
/// Column + 100 rows, in the first channel.
constexpr const char* kRampValue = "vec4(float(pixel.x + 100 * pixel.y), 0.0, 0.0, 1.0)";
constexpr const char* kRamp = R"("ramp": { "type": "compute", "shader": "ramp.comp" })";

class ComputePass : public toy::ComputeFolder {
 protected:
  void SetUp() override {
    ComputeFolder::SetUp();
    write_shader("ramp.comp", kOutput, kRampValue);
    write_shader("scale.comp",
                 std::string(kOutput) +
                     "\nuniform texture2D value;\n"
                     "layout(push_constant) uniform Params { float factor; uint flip; };\n"
                     "layout(constant_id = 3) const int offset = -7;",
                 "(flip != 0u ? -1.0 : 1.0) * factor * texelFetch(value, pixel, 0) + float(offset)");
  }
  static std::string scale(const std::string& more) {
    return std::string(kRamp) + R"(, "scale": { "type": "compute", "shader": "scale.comp",
      "in": { "value": "ramp.value" }, "params": { "factor": 0.5, "flip": false }, )" +
           more + " }";
  }
};

TEST_F(ComputePass, PortsParamsAndReadsFollowFromTheShader) {
  const auto made =
      plan(scale(R"("out": { "value": { "format": "r32_sfloat", "bypass": "value" } })"), R"("image": "scale.value")");
  ASSERT_TRUE(made) << errors_;
  const GraphPass& pass = toy::pass_named(*made, "scale");
  EXPECT_EQ(pass.type->name, "compute");
  ASSERT_EQ(pass.type->ports.size(), 2U);
  const Port* input = pass.type->find_port("value", Direction::in);
  const Port* output = pass.type->find_port("value", Direction::out);
  ASSERT_TRUE(input != nullptr && output != nullptr);
  EXPECT_EQ(input->access, Access::compute_sampled_read);
  EXPECT_EQ(output->access, Access::compute_storage_write);
  EXPECT_EQ(output->extent, ExtentRule::like);
  EXPECT_EQ(output->like, "value");
  EXPECT_EQ(output->parts.front().format, Format::r32_sfloat);
  EXPECT_EQ(pass.params.real("factor"), 0.5);
  EXPECT_FALSE(pass.params.boolean("flip"));
  EXPECT_EQ(pass.params.integer("offset"), -7);
  EXPECT_EQ(pass.type->reads, FrameState::none);
}

TEST_F(ComputePass, ComputesWhatItSays) {
  const auto made = plan(scale(R"("out": { "value": { "format": "rgba32_sfloat" } })"), R"("image": "scale.value")");
  ASSERT_TRUE(made) << errors_;
  const auto results = frames(*made, 1);
  const image::HostImage& image = toy::output_named(results.front(), "image");
  for (uint32_t y = 0; y < 9; ++y)
    for (uint32_t x = 0; x < 20; ++x) ASSERT_EQ(image.at(x, y, 0, 0), 0.5 * (x + 100.0 * y) - 7) << x << " " << y;
}

TEST_F(ComputePass, ParamsComeFromTheGraphAndTheCommandLine) {
  LinkOptions options;
  options.sets = {{"scale.offset", "3"}, {"level", "4"}};
  const std::string passes = std::string(kRamp) + R"(, "scale": { "type": "compute", "shader": "scale.comp",
      "in": { "value": "ramp.value" }, "params": { "factor": "$level", "flip": "$flag" } })";
  const auto made = plan(passes, R"("image": "scale.value")", options);
  ASSERT_TRUE(made) << errors_;
  const auto results = frames(*made, 1);
  EXPECT_EQ(toy::output_named(results.front(), "image").at(2, 1, 0, 0), -4.0 * 102 + 3);
}

TEST_F(ComputePass, DisabledItIsAsIfItHadNeverBeenWritten) {
  LinkOptions options;
  options.disables = {"scale"};
  const auto off = plan(scale(R"("out": { "value": { "bypass": "value" } })"), R"("image": "scale.value")", options);
  ASSERT_TRUE(off) << errors_;
  const auto without = plan(kRamp, R"("image": "ramp.value")");
  ASSERT_TRUE(without) << errors_;
  EXPECT_EQ(plan_hash(*off), plan_hash(*without));
  const auto constant =
      plan(scale(R"("out": { "value": { "bypass": [0.25, 2] } })"), R"("image": "scale.value")", options);
  ASSERT_TRUE(constant) << errors_;
  const auto results = frames(*constant, 1);
  EXPECT_EQ(toy::output_named(results.front(), "image").at(19, 8, 0, 0), 0.25);
  EXPECT_EQ(toy::output_named(results.front(), "image").at(19, 8, 0, 1), 2);
  EXPECT_EQ(toy::output_named(results.front(), "image").at(19, 8, 0, 2), 0);
}

TEST_F(ComputePass, IsHoistedUnlessWhatItReadsChanges) {
  write_shader("static.comp", std::string("#include \"lib/scene.glsl\"\n") + kOutput,
               "vec4(frame.scene_max.x, vertex_at(triangle_at(0).a).position.x, 0, 0)");
  write_shader("eye.comp", std::string("#include \"lib/scene.glsl\"\n") + kOutput, "frame.eye[0]");
  write_shader("seed.comp", std::string("#include \"lib/scene.glsl\"\n") + kOutput, "vec4(frame.ids.y)");
  const auto made = plan(std::string(kRamp) + R"(, "static": { "type": "compute", "shader": "static.comp" },
    "eye": { "type": "compute", "shader": "eye.comp" }, "seed": { "type": "compute", "shader": "seed.comp" })",
                         R"("a": "static.value", "b": "eye.value", "c": "seed.value", "d": "ramp.value")");
  ASSERT_TRUE(made) << errors_;
  EXPECT_NE(toy::pass_named(*made, "ramp").once, "");
  EXPECT_THAT(toy::pass_named(*made, "static").once, HasSubstr("static geometry"));
  EXPECT_EQ(toy::pass_named(*made, "static").type->reads, FrameState::static_geometry | FrameState::dynamic_geometry);
  EXPECT_EQ(toy::pass_named(*made, "eye").once, "");
  EXPECT_EQ(toy::pass_named(*made, "eye").type->reads, FrameState::camera);
  EXPECT_EQ(toy::pass_named(*made, "seed").once, "");
  const auto results = frames(*made, 2);
  EXPECT_EQ(toy::output_named(results[1], "a").at(0, 0, 0, 0), 1) << "the quad is 1 wide";
}

TEST_F(ComputePass, SumsAHistoryRange) {
  write_shader("count.comp", std::string("#include \"lib/scene.glsl\"\n") + kOutput, "vec4(frame.ids.x + 1u)");
  write("sum.comp", R"(#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2DArray past;
layout(r32f) uniform writeonly image2D out_value;
layout(constant_id = 0) const uint past_count = 0u;
layout(constant_id = 1) const uint past_first_age = 0u;
layout(constant_id = 2) const uint past_ring = 1u;
layout(push_constant) uniform Params { uint past_newest_layer; };
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(out_value)))) return;
  float sum = 0.0;
  for (uint age = past_first_age; age < past_first_age + past_count; ++age)
    sum += texelFetch(past, ivec3(pixel, (past_newest_layer + past_ring - age) % past_ring), 0).x;
  imageStore(out_value, pixel, vec4(sum));
}
)");
  const auto made = plan(R"("count": { "type": "compute", "shader": "count.comp" },
    "sum": { "type": "compute", "shader": "sum.comp", "in": { "past": "count.value@1..3" } })",
                         R"("image": "sum.value")");
  ASSERT_TRUE(made) << errors_;
  const auto results = frames(*made, 6);
  const std::vector<double> expected = {0, 1, 1 + 2, 1 + 2 + 3, 2 + 3 + 4, 3 + 4 + 5};
  for (uint32_t frame = 0; frame < 6; ++frame)
    EXPECT_EQ(toy::output_named(results[frame], "image").at(7, 5, 0, 0), expected[frame]) << frame;
}

TEST_F(ComputePass, SizesAndFormats) {
  write_shader("format.comp", "layout(rgba8) uniform writeonly image2D out_value;", "vec4(0.5)");
  write("volume.comp", R"(#version 460
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(r32ui) uniform writeonly uimage3D out_cells;
void main() { imageStore(out_cells, ivec3(gl_GlobalInvocationID), uvec4(gl_GlobalInvocationID.z)); }
)");
  const auto made = plan(R"("view": { "type": "compute", "shader": "format.comp" },
    "trace": { "type": "compute", "shader": "format.comp", "out": { "value": { "size": "trace" } } },
    "fixed": { "type": "compute", "shader": "format.comp", "out": { "value": { "size": "16x8" } } },
    "grid": { "type": "compute", "shader": "volume.comp", "params": { "resolution": 6 } },
    "cube": { "type": "compute", "shader": "volume.comp", "out": { "cells": { "size": "3x4x5" } } })",
                         R"("a": "view.value", "b": "trace.value", "c": "fixed.value", "d": "grid.cells",
                            "e": "cube.cells")");
  ASSERT_TRUE(made) << errors_;
  const std::map<std::string, std::string> expected = {{"view", "rgba8_unorm 20x9"},
                                                       {"trace", "rgba8_unorm 10x5"},
                                                       {"fixed", "rgba8_unorm 16x8"},
                                                       {"grid", "r32_uint 6x6x3"},
                                                       {"cube", "r32_uint 3x4x5"}};
  for (const Value& value : made->graph.values) EXPECT_EQ(to_string(value.desc), expected.at(value.pass)) << value.pass;
  const auto results = frames(*made, 1);
  EXPECT_EQ(toy::output_named(results.front(), "e").at(2, 3, 4, 0), 4);
}

TEST_F(ComputePass, ReadsBundlesAndOptionalInputs) {
  write_shader("normal.comp",
               std::string(kOutput) +
                   "\nuniform texture2D surface_normal;\nuniform utexture2D surface_id;\n"
                   "uniform texture2D extra;\nlayout(constant_id = 0) const bool extra_bound = false;",
               "vec4(texelFetch(surface_normal, pixel, 0).z, float(texelFetch(surface_id, pixel, 0).x), "
               "extra_bound ? texelFetch(extra, pixel, 0).x : -1.0, 0)");
  const std::string passes = R"("gather": { "type": "gather" },
    "normal": { "type": "compute", "shader": "normal.comp", "in": { "surface": "gather.surface" } })";
  const auto made = plan(passes, R"("image": "normal.value")");
  ASSERT_TRUE(made) << errors_;
  EXPECT_EQ(toy::pass_named(*made, "normal").type->find_port("surface", Direction::in)->bundle, "surface");
  const auto results = frames(*made, 1);
  const image::HostImage& image = toy::output_named(results.front(), "image");
  EXPECT_EQ(image.at(10, 4, 0, 0), 1) << "the quad faces the camera";
  EXPECT_EQ(image.at(10, 4, 0, 1), 1);
  EXPECT_EQ(image.at(10, 4, 0, 2), -1);
}

TEST_F(ComputePass, IncludesWhatLiesBesideIt) {
  write("own.glsl", "float own_value() { return 42.0; }\n");
  write_shader("with.comp", std::string("#include \"own.glsl\"\n") + kOutput, "vec4(own_value())");
  const auto made = plan(R"("with": { "type": "compute", "shader": "with.comp" })", R"("image": "with.value")");
  ASSERT_TRUE(made) << errors_;
  EXPECT_EQ(toy::output_named(frames(*made, 1).front(), "image").at(0, 0, 0, 0), 42);
}

TEST_F(ComputePass, ObservingItChangesNoBit) {
  const std::string passes = scale(R"("out": { "value": { "size": "view" } })");
  LinkOptions capture;
  capture.captures = {"*"};
  const auto plain = plan(passes, R"("image": "scale.value")");
  const auto seen = plan(passes, R"("image": "scale.value")", capture);
  ASSERT_TRUE(plain && seen) << errors_;
  const auto one = frames(*plain, 2);
  const auto other = frames(*seen, 2);
  EXPECT_EQ(other.back().captures.size(), 2U);
  EXPECT_EQ(toy::output_named(one.back(), "image").texels, toy::output_named(other.back(), "image").texels);
}

TEST_F(ComputePass, AnotherShaderIsAnotherPlan) {
  const auto before = plan(kRamp, R"("image": "ramp.value")");
  write_shader("ramp.comp", std::string("// the same in other words\n") + kOutput, kRampValue);
  const auto same = plan(kRamp, R"("image": "ramp.value")");
  write_shader("ramp.comp", kOutput, "vec4(1.0)");
  const auto after = plan(kRamp, R"("image": "ramp.value")");
  ASSERT_TRUE(before && same && after) << errors_;
  EXPECT_EQ(plan_hash(*before), plan_hash(*same));
  EXPECT_NE(plan_hash(*before), plan_hash(*after));
}

TEST_F(ComputePass, MisspeltParamsAndInputsAreNamed) {
  EXPECT_FALSE(plan(std::string(kRamp) + R"(, "scale": { "type": "compute", "shader": "scale.comp",
      "in": { "valeu": "ramp.value" }, "params": { "factor": 1, "flip": 0, "ofset": 3 } })",
                    R"("image": "scale.value")"));
  EXPECT_THAT(errors_, HasSubstr("has no param 'ofset'\n  hint: did you mean 'offset'?"));
  EXPECT_THAT(errors_, HasSubstr("has no input 'valeu'\n  hint: did you mean 'value'?"));
}

TEST_F(ComputePass, IsSwappedForATypeButNothingForIt) {
  LinkOptions options;
  options.swaps = {{"scale", "tonemap"}};
  EXPECT_FALSE(plan(scale(R"("out": {})"), R"("image": "scale.value")", options));
  EXPECT_THAT(errors_, HasSubstr("needs input 'radiance'"));
  options.swaps = {{"ramp", "compute"}};
  EXPECT_FALSE(plan(kRamp, R"("image": "ramp.value")", options));
  EXPECT_THAT(errors_, HasSubstr("a pass cannot be swapped for type 'compute'"));
}

}  // namespace
}  // namespace lightloom::run
