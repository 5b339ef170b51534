// render --find-nan, --stop-at-nan and --poison, with pass types that are at fault.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "framework/scene/frame_scene.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Port image_port(Access access) {
  Port port;
  port.name = "image";
  port.direction = Direction::out;
  port.parts = {{"", Format::rg16_sfloat, ""}};
  port.extent = ExtentRule::view;
  port.access = access;
  return port;
}

/// Zeros, but in frames 1 and 2 a NaN and an infinity in the texel 3,1.
PassType nan_type() {
  PassType type;
  type.name = "test_nan";
  type.doc = "For tests.";
  type.ports = {image_port(Access::transfer_write)};
  type.reads = FrameState::time;
  type.host = [](HostContext& context) {
    const HostOutput output = context.output("image", "");
    const uint32_t frame = context.scene().frame;
    const std::array<uint16_t, 2> texel{0x7e01, 0xfc00};
    if (frame == 1 || frame == 2)
      std::memcpy(output.texels.data() + (output.extent.width + 3) * sizeof(texel), texel.data(), sizeof(texel));
  };
  return type;
}

/// Writes the left half alone.
constexpr const char* kLazyShader = R"(#version 460
layout(local_size_x = 4, local_size_y = 4) in;
uniform writeonly image2D out_image;
void main() { imageStore(out_image, ivec2(gl_GlobalInvocationID.xy), vec4(0.0)); }
)";
PassType lazy_type(const std::filesystem::path& shader) {
  PassType type;
  type.name = "test_lazy";
  type.doc = "For tests.";
  type.ports = {image_port(Access::compute_storage_write)};
  type.reads = FrameState::time;
  type.record = [file = shader.string()](PassContext& context) { context.dispatch({file, {4, 4, 1}, {}}); };
  return type;
}

class Checks : public ProgramTest {
 protected:
  Checks() {
    registry_.add(nan_type());
    std::ofstream(folder_ / "lazy.comp") << kLazyShader;
    registry_.add(lazy_type(folder_ / "lazy.comp"));
  }

  int render(const std::string& type, std::vector<std::string> options) {
    std::ofstream(folder_ / "graph.json") << R"({ "lightloom": 1, "name": "faults", "view": { "width": 8, "height": 4 },
                "trace": { "width": 8, "height": 4 },
                "passes": { "faulty": { "type": ")"
                                          << type << R"(" } }, "outputs": { "image": "faulty.image" } })";
    std::vector<std::string> arguments = {"render",
                                          (folder_ / "graph.json").string(),
                                          "--scene",
                                          (source_dir() / "samples/scenes/atrium.scene.json").string(),
                                          "--frames",
                                          "0..3",
                                          "--validate",
                                          "--out",
                                          (folder_ / "out").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }

  [[nodiscard]] nlohmann::ordered_json record() const {
    return nlohmann::ordered_json::parse(read_text_file(folder_ / "out/run.json"));
  }
};

constexpr const char* kNan =
    "faulty.image: faulty made NaN in 1 and infinity in 1 of 32 texels, first at 3,1, (nan, -inf); ";

TEST_F(Checks, what_makes_nan_is_a_warning) {
  EXPECT_EQ(render("test_nan", {"--find-nan"}), 0);
  EXPECT_EQ(err_, std::string("warning: ") + kNan + "frames 1..2; it reads no other value\n");
  EXPECT_THAT(out_, HasSubstr("4 frames in"));
  EXPECT_EQ(record()["non_finite"]["made"][0]["frames"].dump(), "[[1,2]]");
  EXPECT_EQ(record()["non_finite"]["made"][0]["texel"].dump(), R"(["nan","-inf"])");
  EXPECT_FALSE(record().contains("unwritten"));
}

TEST_F(Checks, a_render_may_end_at_the_first_nan) {
  EXPECT_EQ(render("test_nan", {"--stop-at-nan"}), 1);
  EXPECT_EQ(err_, std::string("warning: ") + kNan + "frame 1; it reads no other value\n" +
                      "error: ended at the first NaN or infinity: faulty.image\n");
  EXPECT_THAT(out_, HasSubstr("2 frames in"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/image.0001.exr"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/image.0002.exr"));
  EXPECT_EQ(record()["frames"].dump(), R"({"first":0,"last":1})");
}

TEST_F(Checks, without_them_nothing_is_said) {
  EXPECT_EQ(render("test_nan", {}), 0);
  EXPECT_THAT(err_, IsEmpty());
  EXPECT_FALSE(record().contains("non_finite"));
}

TEST_F(Checks, what_leaves_texels_unwritten_fails_the_render) {
  EXPECT_EQ(render("test_lazy", {"--poison"}), 1);
  EXPECT_EQ(err_,
            "warning: faulty.image: faulty leaves 16 of 32 texels unwritten, first 4,0; frames 0..3\n"
            "error: the pictures depend on what nobody wrote, or may: faulty.image\n");
  EXPECT_EQ(record()["unwritten"].dump(),
            R"([{"value":"faulty.image","pass":"faulty","frames":[[0,3]],"unwritten_texels":16,"texels":32,)"
            R"("first":[4,0]}])");
  EXPECT_EQ(render("test_nan", {"--poison"}), 0) << err_;
}

}  // namespace
}  // namespace lightloom::cli
