#include "framework/gpu/pipeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/samplers.hpp"
#include "framework/gpu/transfer.hpp"
#include "tests/gpu/gpu_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::gpu {
namespace {

using test::compile_compute;
using test::error_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PipelineTest : public test::DeviceTest {
 protected:
  [[nodiscard]] static Image make_image(VkFormat format, Extent3 extent, Dimension dimension = Dimension::d2,
                                        uint32_t layers = 1) {
    return Image(device(), {.format = format,
                            .dimension = dimension,
                            .extent = extent,
                            .layers = layers,
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                     VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                            .name = "test image"});
  }
  template <class T>
  static void fill(const Image& image, const std::vector<T>& texels) {
    const SubimageData data{.texels = std::as_bytes(std::span(texels))};
    upload_image(device(), image, std::span(&data, 1));
  }
  static void dispatch(const Pipeline& pipeline, const ResourceMap& resources, std::span<const std::byte> push = {}) {
    DescriptorAllocator descriptors(device());
    const VkDescriptorSet set = descriptors.allocate(pipeline, resources);
    device().run_commands([&](VkCommandBuffer commands) {
      pipeline.bind(commands, set, push);
      vkCmdDispatch(commands, 1, 1, 1);
    });
  }
};

const char* const kScale = R"(
layout(local_size_x = 4, local_size_y = 4) in;
layout(constant_id = 0) const int factor = 2;
layout(constant_id = 1) const bool negative = false;
layout(push_constant) uniform Push { float offset; } push;
uniform texture2D source;
writeonly uniform image2D out_scaled;
void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  vec4 value = texelFetch(source, p, 0) * float(factor) + push.offset;
  imageStore(out_scaled, p, negative ? -value : value);
}
)";

std::vector<float> ramp() {
  std::vector<float> texels(16);
  std::iota(texels.begin(), texels.end(), 0.0f);
  return texels;
}

TEST_F(PipelineTest, DispatchBindsByNameAndSpecializes) {
  const ShaderProgram program = compile_compute(kScale);
  const Image source = make_image(VK_FORMAT_R32_SFLOAT, {4, 4, 1});
  const Image scaled = make_image(VK_FORMAT_R32_SFLOAT, {4, 4, 1});
  fill(source, ramp());
  fill(scaled, std::vector<float>(16, -1.0f));
  const std::array push_values{ShaderValue{"offset", 0.25f}};
  const auto push = encode_push_constants(program.reflection, push_values);
  struct Case {
    std::vector<ShaderValue> constants;
    float factor;
  };
  const std::vector<Case> cases{
      {{}, 2.0f}, {{{"factor", 3}}, 3.0f}, {{{"negative", true}, {"factor", 5u}}, -5.0f}, {{{"negative", 1}}, -2.0f}};
  for (const Case& one : cases) {
    const Pipeline pipeline(device(), program, one.constants);
    dispatch(pipeline, {{"source", resource(source)}, {"out_scaled", resource(scaled)}}, push);
    const auto result = test::values_of<float>(read_image(device(), scaled, whole_level(scaled)));
    const float sign = one.factor < 0 ? -1.0f : 1.0f;
    for (size_t i = 0; i < 16; ++i) {
      EXPECT_EQ(result[i], one.factor * static_cast<float>(i) + sign * 0.25f) << "texel " << i;
    }
  }
}

TEST_F(PipelineTest, ArraysOfSamplersAndStorageVolumes) {
  const ShaderProgram program = compile_compute(R"(
layout(local_size_x = 1) in;
uniform sampler2DArray pages[2];
layout(r32ui) writeonly uniform uimage3D out_volume;
void main() {
  imageStore(out_volume, ivec3(0, 0, 0), uvec4(textureLod(pages[0], vec3(0.5, 0.5, 1), 0.0).x * 255.0 + 0.5));
  imageStore(out_volume, ivec3(0, 0, 1), uvec4(textureLod(pages[1], vec3(0.5, 0.5, 0), 0.0).x * 255.0 + 0.5));
}
)");
  const Samplers samplers(device());
  const Image first = make_image(VK_FORMAT_R8_UNORM, {1, 1, 1}, Dimension::d2, 2);
  const Image second = make_image(VK_FORMAT_R8_UNORM, {1, 1, 1});
  const Image volume = make_image(VK_FORMAT_R32_UINT, {1, 1, 2}, Dimension::d3);
  const std::array values{std::byte{10}, std::byte{20}, std::byte{30}};
  const std::array first_layers{SubimageData{.layer = 0, .texels = std::span(values).subspan(0, 1)},
                                SubimageData{.layer = 1, .texels = std::span(values).subspan(1, 1)}};
  upload_image(device(), first, first_layers);
  upload_image(device(), second, std::array{SubimageData{.texels = std::span(values).subspan(2, 1)}});
  fill(volume, std::vector<uint32_t>(2));
  const Pipeline pipeline(device(), program, {});
  const std::vector<ImageResource> pages{{.view = first.array_view(), .sampler = samplers.repeat_trilinear()},
                                         {.view = second.array_view(), .sampler = samplers.clamp_linear()}};
  dispatch(pipeline, {{"pages", pages}, {"out_volume", resource(volume)}});
  EXPECT_THAT(test::values_of<uint32_t>(read_image(device(), volume, whole_level(volume))), ElementsAre(20u, 30u));
}

TEST_F(PipelineTest, LayersOfARingAreReadAsArrayAndWrittenOneByOne) {
  const ShaderProgram write = compile_compute(R"(
layout(local_size_x = 1) in;
layout(push_constant) uniform Push { float value; };
writeonly uniform image2D out_value;
void main() { imageStore(out_value, ivec2(0), vec4(value)); }
)");
  const Image ring = make_image(VK_FORMAT_R32_SFLOAT, {1, 1, 1}, Dimension::d2, 3);
  upload_image(device(), ring, {});
  const Pipeline pipeline(device(), write, {});
  for (uint32_t layer = 0; layer < 3; ++layer) {
    const std::array values{ShaderValue{"value", static_cast<float>(layer + 1)}};
    dispatch(pipeline, {{"out_value", resource(ring.layer_view(layer))}},
             encode_push_constants(write.reflection, values));
  }
  for (uint32_t layer = 0; layer < 3; ++layer) {
    EXPECT_THAT(test::values_of<float>(read_image(device(), ring, whole_level(ring, layer))),
                ElementsAre(static_cast<float>(layer + 1)));
  }
}

TEST_F(PipelineTest, AnUnknownConstantIsAnErrorWithAHint) {
  const ShaderProgram program = compile_compute(kScale);
  const std::array constants{ShaderValue{"factr", 3}};
  const Error error = error_of([&] { const Pipeline pipeline(device(), program, constants); });
  EXPECT_EQ(error.code(), ExitCode::invalid_input);
  EXPECT_THAT(error.what(), HasSubstr("test.comp has no specialization constant 'factr'"));
  EXPECT_THAT(error.hint(), HasSubstr("factor"));
}

TEST_F(PipelineTest, CacheMakesEachPipelineOnce) {
  const ShaderProgram program = compile_compute(kScale);
  PipelineCache cache(device());
  const std::array three{ShaderValue{"factor", 3}, ShaderValue{"negative", false}};
  const std::array same{ShaderValue{"negative", 0u}, ShaderValue{"factor", 3.0f}};
  const std::array four{ShaderValue{"factor", 4}, ShaderValue{"negative", false}};
  const Pipeline& first = cache.compute(program, three);
  EXPECT_EQ(&first, &cache.compute(program, same));
  EXPECT_NE(&first, &cache.compute(program, four));
  EXPECT_NE(&first, &cache.compute(program, {}));
  EXPECT_EQ(cache.size(), 3u);
  EXPECT_EQ(&first, &cache.compute(compile_compute(kScale), three)) << "the same text is the same program";
}

TEST_F(PipelineTest, WrongNumberOfPushConstantBytesIsAnError) {
  const Pipeline pipeline(device(), compile_compute(kScale), {});
  EXPECT_THAT(error_of([&] {
                device().run_commands([&](VkCommandBuffer commands) { pipeline.bind(commands, VK_NULL_HANDLE, {}); });
              }).what(),
              HasSubstr("takes 4 bytes of push constants, not 0"));
}

class DescriptorErrors : public PipelineTest {
 protected:
  [[nodiscard]] static std::string message(const std::string& text, const ResourceMap& resources) {
    const Pipeline pipeline(device(), compile_compute(text), {});
    DescriptorAllocator descriptors(device());
    const Error error = error_of([&] { static_cast<void>(descriptors.allocate(pipeline, resources)); });
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
  const char* reader_ = R"(
layout(local_size_x = 1) in;
uniform texture2D source;
layout(std430) buffer Result { vec4 result; };
void main() { result = texelFetch(source, ivec2(0), 0); }
)";
  Image image_ = make_image(VK_FORMAT_R32_SFLOAT, {2, 2, 1});
  Buffer result_ = Buffer(device(), 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "result");
};

TEST_F(DescriptorErrors, AMissingNameIsNamed) {
  EXPECT_EQ(message(reader_, {{"Result", resource(result_)}}),
            "shader test.comp: sampled image 'source' is not provided");
}

TEST_F(DescriptorErrors, AWrongKindIsNamed) {
  EXPECT_EQ(message(reader_, {{"source", resource(result_)}, {"Result", resource(result_)}}),
            "shader test.comp: sampled image 'source' is given a buffer");
  EXPECT_EQ(message(reader_, {{"source", resource(image_)}, {"Result", resource(image_)}}),
            "shader test.comp: storage buffer 'Result' is given an image");
}

TEST_F(DescriptorErrors, AWrongDimensionOrClassIsNamed) {
  const Image volume = make_image(VK_FORMAT_R32_SFLOAT, {2, 2, 2}, Dimension::d3);
  EXPECT_EQ(message(reader_, {{"source", resource(volume)}, {"Result", resource(result_)}}),
            "shader test.comp: sampled image 'source' is 2D and is given a 3D image");
  const Image ids = make_image(VK_FORMAT_R32_UINT, {2, 2, 1});
  EXPECT_THAT(message(reader_, {{"source", resource(ids)}, {"Result", resource(result_)}}),
              HasSubstr("reads floating point numbers and is given an image of unsigned integers"));
}

TEST_F(DescriptorErrors, ATooSmallBufferIsNamed) {
  const Buffer small(device(), 12, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device, "small");
  EXPECT_THAT(message(reader_, {{"source", resource(image_)}, {"Result", resource(small)}}),
              HasSubstr("needs 16 bytes and is given a buffer of 12"));
}

TEST_F(DescriptorErrors, AWrongArrayLengthOrAMissingSamplerIsNamed) {
  const char* pages = R"(
layout(local_size_x = 1) in;
uniform sampler2D pages[2];
layout(std430) buffer Result { vec4 result; };
void main() { result = textureLod(pages[0], vec2(0), 0.0) + textureLod(pages[1], vec2(0), 0.0); }
)";
  const Samplers samplers(device());
  EXPECT_THAT(message(pages, {{"pages", resource(image_, samplers.clamp_linear())}, {"Result", resource(result_)}}),
              HasSubstr("has 2 elements and is given 1"));
  const std::vector<ImageResource> without_sampler(2, {.view = image_.view()});
  EXPECT_THAT(message(pages, {{"pages", without_sampler}, {"Result", resource(result_)}}),
              HasSubstr("without a sampler"));
}

TEST_F(PipelineTest, DescriptorPoolsGrow) {
  const Pipeline pipeline(device(), compile_compute(kScale), {});
  const Image image = make_image(VK_FORMAT_R32_SFLOAT, {4, 4, 1});
  DescriptorAllocator descriptors(device());
  const ResourceMap resources{{"source", resource(image)}, {"out_scaled", resource(image)}};
  std::vector<VkDescriptorSet> sets;
  for (int i = 0; i < 1000; ++i) sets.push_back(descriptors.allocate(pipeline, resources));
  std::sort(sets.begin(), sets.end());
  EXPECT_EQ(std::unique(sets.begin(), sets.end()), sets.end());
  descriptors.reset();
  EXPECT_NE(descriptors.allocate(pipeline, resources), VkDescriptorSet{VK_NULL_HANDLE});
}

using SnippetTest = test::DeviceTest;

TEST_F(SnippetTest, RunsABodyOverInputs) {
  const std::vector<float> inputs{1, 4, 9, 16, 25};
  EXPECT_THAT(
      test::run_snippet(device(), "void evaluate(uint index) { outputs[index] = sqrt(inputs[index]); }", inputs, 5, 5),
      ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(SnippetTest, RunsOnlyTheInvocationsAskedForAndMayIgnoreInputs) {
  EXPECT_THAT(test::run_snippet(device(), "void evaluate(uint index) { outputs[index] = 1.0; }", {}, 4, 3),
              ElementsAre(1, 1, 1, 0));
}

TEST_F(SnippetTest, LinesOfErrorsAreThoseOfTheBody) {
  EXPECT_THAT(error_of([] {
                static_cast<void>(test::run_snippet(device(), "void evaluate(uint index) {\n  nothing;\n}", {}, 1, 1));
              }).what(),
              HasSubstr("snippet:2: 'nothing'"));
}

}  // namespace
}  // namespace lightloom::gpu
