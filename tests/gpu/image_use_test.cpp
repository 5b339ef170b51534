// What shaders do with images, read off their SPIR-V, and where their text declares them.
#include "framework/gpu/image_use.hpp"

#include <gtest/gtest.h>

#include "framework/gpu/declaration.hpp"
#include "framework/gpu/reflection.hpp"

namespace lightloom::gpu {
namespace {

Reflection reflect_text(const std::string& declarations, const std::string& functions, const std::string& body) {
  const ShaderSource source{.name = "use.comp",
                            .text = "#version 460\nlayout(local_size_x = 1) in;\n" + declarations + functions +
                                    "void main() {\n" + body + "\n}\n",
                            .stage = Stage::compute};
  ShaderCompiler compiler({});
  return reflect(compiler.compile({&source, 1}));
}

struct UseRow {
  const char* body;
  bool reads;
  bool writes;
};

TEST(ImageUse, LoadsStoresAndAtomicsAreToldApart) {
  const std::string declarations =
      "layout(r32ui) uniform uimage2D image;\nlayout(r32ui) uniform writeonly uimage2D out_sink;\n";
  for (const UseRow& row :
       {UseRow{"imageStore(image, ivec2(0), uvec4(1));", false, true},
        UseRow{"imageStore(out_sink, ivec2(0), imageLoad(image, ivec2(0)));", true, false},
        UseRow{"imageAtomicAdd(image, ivec2(0), 1u);", true, true},
        UseRow{"if (imageSize(image).x > 3) imageStore(out_sink, ivec2(0), uvec4(1));", false, false},
        UseRow{"if (gl_GlobalInvocationID.x > 1000u) imageStore(image, ivec2(0), uvec4(1));", false, true}}) {
    const Reflection reflection = reflect_text(declarations, "", row.body);
    const Binding* image = reflection.find_binding("image");
    ASSERT_NE(image, nullptr) << row.body;
    EXPECT_EQ(image->reads, row.reads) << row.body;
    EXPECT_EQ(image->writes, row.writes) << row.body;
    EXPECT_EQ(image->format, Format::r32_uint);
  }
}

TEST(ImageUse, IsFollowedThroughFunctions) {
  const Reflection reflection =
      reflect_text("uniform writeonly image2D one;\nlayout(r32f) uniform image2D other;\nuniform texture2D source;\n",
                   "vec4 fetch(texture2D from, int x) { return x > 5 ? texelFetch(from, ivec2(x), 0) : vec4(0.0); }\n"
                   "void put(writeonly image2D into, vec4 value) { imageStore(into, ivec2(0), value); }\n",
                   "put(one, fetch(source, int(gl_GlobalInvocationID.x)) + imageLoad(other, ivec2(1)));");
  EXPECT_TRUE(reflection.find_binding("one")->writes);
  EXPECT_FALSE(reflection.find_binding("one")->reads);
  EXPECT_TRUE(reflection.find_binding("other")->reads);
  EXPECT_FALSE(reflection.find_binding("other")->writes);
  EXPECT_TRUE(reflection.find_binding("source")->reads);
  EXPECT_FALSE(reflection.find_binding("source")->format.has_value());
}

TEST(ImageUse, DefaultsOfConstantsAreRead) {
  const Reflection reflection = reflect_text(
      "layout(constant_id = 0) const float real = 0.5;\nlayout(constant_id = 1) const int whole = -3;\n"
      "layout(constant_id = 2) const bool yes = true;\nlayout(constant_id = 3) const bool no = false;\n"
      "layout(r32f) uniform writeonly image2D out_sink;\n",
      "", "imageStore(out_sink, ivec2(0), vec4(yes && !no ? real : float(whole)));");
  EXPECT_EQ(reflection.find_constant("real")->default_bits, 0x3F000000u);
  EXPECT_EQ(static_cast<int32_t>(reflection.find_constant("whole")->default_bits), -3);
  EXPECT_EQ(reflection.find_constant("yes")->default_bits, 1u);
  EXPECT_EQ(reflection.find_constant("no")->default_bits, 0u);
}

constexpr const char* kText = R"(#version 460
// uniform texture2D radiance;
/* uniform
   texture2D radiance; */
#define uniform_of radiance
float radiance_of(float radiance) { float amount = 2.0; return radiance * amount; }
uniform texture2D first, radiance;
uniform writeonly image2D
    out_radiance;
layout(push_constant) uniform Params {
  int other;
  float amount;   // what it is
  mat4 matrices[3];
};
layout(std430) readonly buffer TableBlock { float values[]; } table;
layout(constant_id = 4) const float sharpness = 1.0;
)";

TEST(Declaration, IsFoundInTheInterfaceAlone) {
  EXPECT_EQ(declaration_line(kText, "radiance"), 7u) << "neither a comment nor what a function calls so";
  EXPECT_EQ(declaration_line(kText, "first"), 7u);
  EXPECT_EQ(declaration_line(kText, "out_radiance"), 9u);
  EXPECT_EQ(declaration_line(kText, "other"), 11u);
  EXPECT_EQ(declaration_line(kText, "amount"), 12u);
  EXPECT_EQ(declaration_line(kText, "matrices"), 13u);
  EXPECT_EQ(declaration_line(kText, "TableBlock"), 15u);
  EXPECT_EQ(declaration_line(kText, "sharpness"), 16u);
  EXPECT_EQ(declaration_line(kText, "absent"), std::nullopt);
  EXPECT_EQ(declaration_line("uniform texture2D ", "radiance"), std::nullopt);
  EXPECT_EQ(declaration_line("/* open", "radiance"), std::nullopt);
}

}  // namespace
}  // namespace lightloom::gpu
