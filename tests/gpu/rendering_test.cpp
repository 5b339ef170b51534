#include "framework/gpu/rendering.hpp"

#include <array>
#include <optional>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/timestamps.hpp"
#include "framework/gpu/transfer.hpp"
#include "tests/gpu/gpu_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

using test::error_of;
using ::testing::HasSubstr;

// A corner (x, y, z of clip space) per vertex, three to a triangle; the colour is the triangle's number.
const char* const kVertex = R"(
layout(std430) readonly buffer CornerBlock { vec4 corners[]; };
out vec2 position;
flat out uint triangle;
void main() {
  gl_Position = vec4(corners[gl_VertexIndex].xyz, 1.0);
  position = gl_Position.xy;
  triangle = uint(gl_VertexIndex) / 3u + 1u;
}
)";
// The order of the inputs is not that of the vertex stage: names join them.
const char* const kFragment = R"(
flat in uint triangle;
in vec2 position;
layout(location = 0) out vec4 out_position;
layout(location = 1) out uvec2 out_id;
void main() {
  out_position = vec4(position, 0.0, 1.0);
  out_id = uvec2(triangle, gl_FrontFacing ? 1u : 0u);
}
)";

constexpr uint32_t kSize = 16;

class RenderingTest : public test::DeviceTest {
 protected:
  [[nodiscard]] static Image attachment(VkFormat format, VkImageUsageFlags usage) {
    return Image(device(), {.format = format,
                            .extent = {kSize, kSize, 1},
                            .usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            .name = "attachment"});
  }

  /// Draws triangles given by clip space corners.
  void draw(const std::vector<float>& corners) {
    const Buffer buffer(device(), corners.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        MemoryKind::upload, "corners");
    upload_buffer(device(), buffer, std::as_bytes(std::span(corners)));
    PipelineCache pipelines(device());
    const ShaderProgram program =
        test::compile_program({{"a.vert", kVertex, Stage::vertex}, {"a.frag", kFragment, Stage::fragment}});
    const Pipeline& pipeline =
        pipelines.graphics(program, {}, {{position_.spec().format, id_.spec().format}, depth_.spec().format});
    DescriptorAllocator descriptors(device());
    const VkDescriptorSet set = descriptors.allocate(pipeline, {{"CornerBlock", resource(buffer)}});
    device().run_commands([&](VkCommandBuffer commands) {
      for (const Image* image : {&position_, &id_, &depth_}) {
        record_layout_change(commands, *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
      }
      VkClearColorValue no_id{};
      const std::array colors{ColorTarget{position_.layer_view(0), VkClearColorValue{{9, 9, 9, 9}}},
                              ColorTarget{id_.layer_view(0), no_id}};
      begin_rendering(commands, {kSize, kSize}, colors, DepthTarget{depth_.layer_view(0), 1.0f});
      pipeline.bind(commands, set, {});
      vkCmdDraw(commands, static_cast<uint32_t>(corners.size() / 4), 1, 0, 0);
      vkCmdEndRendering(commands);
    });
    positions_ = test::values_of<float>(read_image(device(), position_, whole_level(position_)));
    ids_ = test::values_of<uint32_t>(read_image(device(), id_, whole_level(id_)));
    depths_ = test::values_of<float>(read_image(device(), depth_, whole_level(depth_)));
  }

  Image position_ = attachment(VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  Image id_ = attachment(VK_FORMAT_R32G32_UINT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  Image depth_ = attachment(VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  std::vector<float> positions_;
  std::vector<uint32_t> ids_;
  std::vector<float> depths_;
};

/// Clip space coordinate of the centre of texel i.
float centre(size_t i) {
  return (static_cast<float>(i) + 0.5f) / static_cast<float>(kSize) * 2.0f - 1.0f;
}

// Below the diagonal x + y = 0.1 the triangle covers a texel centre, above it does not; the bounds are exact.
TEST_F(RenderingTest, ATriangleFillsTwoAttachmentsAndDepth) {
  draw({-1, -1, 0.25f, 0, 1.1f, -1, 0.25f, 0, -1, 1.1f, 0.25f, 0});
  for (size_t y = 0; y < kSize; ++y) {
    for (size_t x = 0; x < kSize; ++x) {
      const size_t texel = y * kSize + x;
      const bool inside = centre(x) + centre(y) < 0.1f;
      EXPECT_EQ(ids_[2 * texel], inside ? 1u : 0u) << x << "," << y;
      EXPECT_EQ(depths_[texel], inside ? 0.25f : 1.0f) << x << "," << y;
      EXPECT_NEAR(positions_[4 * texel], inside ? centre(x) : 9.0f, 1e-5f) << x << "," << y;
      EXPECT_NEAR(positions_[4 * texel + 1], inside ? centre(y) : 9.0f, 1e-5f) << x << "," << y;
    }
  }
}

TEST_F(RenderingTest, TheNearerTriangleWinsAndALaterEqualOneReplaces) {
  const std::vector<float> near{-1, -1, 0.2f, 0, 3, -1, 0.2f, 0, -1, 3, 0.2f, 0};
  const std::vector<float> far{-1, -1, 0.8f, 0, 3, -1, 0.8f, 0, -1, 3, 0.8f, 0};
  const auto join = [](std::vector<float> a, const std::vector<float>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  draw(join(near, far));
  EXPECT_EQ(ids_[0], 1u);
  EXPECT_EQ(depths_[0], 0.2f);
  draw(join(far, near));
  EXPECT_EQ(ids_[0], 2u);
  draw(join(near, near));
  EXPECT_EQ(ids_[0], 2u);
}

TEST_F(RenderingTest, BothSidesAreDrawnAndCounterClockwiseOnTheScreenIsTheFront) {
  // y points down: lower left, lower right, upper left is counter-clockwise for someone who looks at the picture.
  draw({-1, 1, 0, 0, 3, 1, 0, 0, -1, -3, 0, 0});
  EXPECT_EQ(ids_[0], 1u);
  EXPECT_EQ(ids_[1], 1u);
  draw({-1, 1, 0, 0, -1, -3, 0, 0, 3, 1, 0, 0});
  EXPECT_EQ(ids_[0], 1u);
  EXPECT_EQ(ids_[1], 0u);
}

TEST_F(RenderingTest, OutputsThatDoNotFitTheAttachmentsAreErrors) {
  const ShaderProgram program =
      test::compile_program({{"a.vert", kVertex, Stage::vertex}, {"a.frag", kFragment, Stage::fragment}});
  const auto message = [&](const AttachmentFormats& formats) {
    return std::string(error_of([&] { const Pipeline pipeline(device(), program, {}, formats); }).what());
  };
  EXPECT_THAT(message({{VK_FORMAT_R32G32B32A32_SFLOAT}, VK_FORMAT_UNDEFINED}),
              HasSubstr("output 'out_id' at location 1 has no attachment; there are 1"));
  EXPECT_THAT(message({{VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32_SFLOAT}, VK_FORMAT_UNDEFINED}),
              HasSubstr("output 'out_id' and its attachment are not both float or both uint"));
}

TEST_F(RenderingTest, PipelinesDifferByAttachmentFormats) {
  const ShaderProgram program =
      test::compile_program({{"a.vert", kVertex, Stage::vertex}, {"a.frag", kFragment, Stage::fragment}});
  PipelineCache cache(device());
  const AttachmentFormats full{{VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32_UINT}, VK_FORMAT_D32_SFLOAT};
  const AttachmentFormats half{{VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32_UINT}, VK_FORMAT_D32_SFLOAT};
  EXPECT_EQ(&cache.graphics(program, {}, full), &cache.graphics(program, {}, full));
  EXPECT_NE(&cache.graphics(program, {}, full), &cache.graphics(program, {}, half));
}

using TimestampTest = test::DeviceTest;

TEST_F(TimestampTest, TimesGrowAlongTheCommands) {
  const TimestampPool pool(device(), 4);
  ASSERT_EQ(pool.available(), device().timestamp_bits() != 0);
  const Buffer buffer(device(), 8 << 20, 0, MemoryKind::device, "work");
  for (int repeat = 0; repeat < 2; ++repeat) {
    device().run_commands([&](VkCommandBuffer commands) {
      pool.reset(commands);
      for (uint32_t i = 0; i < 3; ++i) {
        pool.write(commands, i);
        record_full_barrier(commands);
        vkCmdFillBuffer(commands, buffer.get(), 0, VK_WHOLE_SIZE, i);
        record_full_barrier(commands);
      }
      pool.write(commands, 3);
    });
    const std::vector<double> times = pool.nanoseconds(4);
    if (!pool.available()) {
      EXPECT_TRUE(times.empty());
      continue;
    }
    ASSERT_EQ(times.size(), 4u);
    EXPECT_EQ(times[0], 0.0);
    for (size_t i = 1; i < 4; ++i) EXPECT_GE(times[i], times[i - 1]);
    EXPECT_GT(times[3], 0.0);
    EXPECT_LT(times[3], 60e9);
  }
}

TEST_F(TimestampTest, ReadingWhatWasNotWrittenIsAnError) {
  const TimestampPool pool(device(), 2);
  if (!pool.available()) GTEST_SKIP() << "device '" << device().info().name << "' has no timestamps";
  device().run_commands([&](VkCommandBuffer commands) {
    pool.reset(commands);
    pool.write(commands, 0);
  });
  EXPECT_THROW(static_cast<void>(pool.nanoseconds(2)), Error);
  EXPECT_EQ(pool.nanoseconds(1).size(), 1u);
}

}  // namespace
}  // namespace lightloom::gpu
