#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "framework/base/error.hpp"
#include "framework/scene/camera_path.hpp"
#include "framework/scene/load_options.hpp"
#include "tests/scene/gltf_builder.hpp"
#include "tests/support/peak_memory.hpp"

// Small files that claim much: each must be refused by a limit, within a second and without the memory it asks for.

namespace lightloom::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::TemporaryFolder;
using ::testing::HasSubstr;

void expect_refused(const std::filesystem::path& file, const std::string& sentence, const std::string& limit) {
  SCOPED_TRACE(sentence);
  const ::lightloom::test::Usage usage;
  try {
    (void)load_scene(file);
    ADD_FAILURE() << "the file loads";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_THAT(error.what(), HasSubstr(sentence));
    if (!limit.empty()) {
      EXPECT_THAT(error.hint(), HasSubstr("--limit " + limit + "="));
    }
  }
  EXPECT_LT(usage.seconds(), 1.0);
  EXPECT_LT(usage.megabytes(), 300u);
}

std::string repeated(const std::string& text, size_t count) {
  std::string result = text;
  result.reserve((text.size() + 1) * count);
  for (size_t i = 1; i < count; ++i) result += "," + text;
  return result;
}

TEST(Usage, SeesMemoryThatIsTaken) {
  const ::lightloom::test::Usage usage;
  std::vector<char> taken(size_t{1} << 29, 'x');
  EXPECT_EQ(taken[taken.size() / 2], 'x');
  EXPECT_GE(usage.megabytes(), 100u);
  EXPECT_GT(usage.seconds(), 0);
}

class Claims : public ::testing::Test {
 protected:
  void expect_gltf_refused(const std::string& members, const std::string& sentence, const std::string& limit) {
    expect_refused(folder_.write("a.gltf", R"({"asset":{"version":"2.0"},)" + members + "}"), sentence, limit);
  }
  /// A textured quad with these bytes as its image.
  void expect_image_refused(const std::vector<uint8_t>& bytes, const std::string& sentence, const std::string& limit) {
    GltfBuilder builder;
    builder.append("images", {{"uri", "x.png"}});
    builder.append("textures", {{"source", 0}});
    builder.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.node({{"mesh", builder.quad(0)}});
    folder_.write("x.png", {bytes.begin(), bytes.end()});
    expect_refused(folder_.write("image.gltf", builder.gltf()), sentence, limit);
  }
  void expect_environment_refused(const std::string& bytes, const std::string& sentence, const std::string& limit) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.quad()}});
    folder_.write("quad.gltf", builder.gltf());
    folder_.write("sky", bytes);
    const json scene = {{"lightloom_scene", 1}, {"gltf", "quad.gltf"}, {"environment", {{"image", "sky"}}}};
    expect_refused(folder_.write("a.scene.json", scene.dump()), sentence, limit);
  }
  TemporaryFolder folder_;
};

TEST_F(Claims, OfManyElements) {
  expect_gltf_refused(R"("nodes":[)" + repeated("{}", 1'000'000) + "]", "nodes has 1000000 nodes", "nodes");
  expect_gltf_refused(R"("nodes":[)" + repeated(R"({"mesh":0})", 1'000'000) + "]", "nodes has 1000000 nodes", "nodes");
  expect_gltf_refused(R"("materials":[)" + repeated("{}", 1'000'000) + "]", "materials has 1000000 elements",
                      "elements");
  expect_gltf_refused(R"("extras":{"a":[)" + repeated("0", 5'000'000) + "]}", "the JSON has 5000", "json_values");
  expect_gltf_refused(R"("meshes":[{"primitives":[)" + repeated(R"({"attributes":{}})", 600'000) + "]}]",
                      "the JSON has", "json_values");
  expect_gltf_refused(R"("extras":)" + std::string(1'000'000, '['), "the JSON has 201 levels", "json_depth");
  expect_gltf_refused(R"("nodes":[{"name":")" + std::string(1'000'000, 'x') + R"("}])",
                      "nodes[0].name has 1000000 bytes", "name_bytes");
}

TEST_F(Claims, OfGigabytes) {
  expect_gltf_refused(R"("buffers":[{"byteLength":8000000000,"uri":"data:application/octet-stream;base64,AAAA"}])",
                      "buffers[0] has 3 bytes, expected byteLength 8000000000", "");
  expect_gltf_refused(R"("accessors":[{"componentType":5126,"count":2000000000,"type":"VEC3"}],
                        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])",
                      "with meshes[0] the file has 2000000000 vertices", "vertices");
  expect_gltf_refused(R"("accessors":[{"componentType":5126,"count":100000,"type":"VEC3"}],
                        "meshes":[)" +
                          repeated(R"({"primitives":[{"attributes":{"POSITION":0}}]})", 1000) + "]",
                      "with meshes[83] the file has 8400000 vertices", "vertices");
  expect_gltf_refused(R"("accessors":[{"componentType":5126,"count":2000000000,"type":"MAT4"}],
                        "skins":[{"joints":[0],"inverseBindMatrices":0}],"nodes":[{}])",
                      "has 32000000000 values", "accessor_values");
  const std::filesystem::path sparse = folder_.write("hole.bin", "");
  std::filesystem::resize_file(sparse, uint64_t{4} << 30);
  expect_gltf_refused(R"("buffers":[{"byteLength":4000000000,"uri":"hole.bin"}])", "has 4000000000 bytes",
                      "file_bytes");
  std::filesystem::resize_file(folder_.write("hole.gltf", "{"), uint64_t{4} << 30);
  expect_refused(folder_.path() / "hole.gltf", "has 4294967296 bytes", "file_bytes");
  std::filesystem::resize_file(folder_.write("hole.scene.json", "{"), uint64_t{4} << 30);
  expect_refused(folder_.path() / "hole.scene.json", "has 4294967296 bytes", "json_bytes");
  EXPECT_THROW((void)read_camera_path(folder_.path() / "hole.scene.json"), Error);
}

TEST_F(Claims, OfManyInstances) {
  GltfBuilder builder;
  for (int i = 0; i < 1000; ++i) builder.node({{"mesh", builder.json.contains("meshes") ? 0 : builder.quad()}});
  folder_.write("nodes.gltf", builder.gltf());
  std::string instances = repeated(R"({"gltf":"nodes.gltf"})", 1000);
  const std::filesystem::path scene =
      folder_.write("a.scene.json", R"({"lightloom_scene":1,"gltf":"nodes.gltf","instances":[)" + instances + "]}");
  expect_refused(scene, "has 200200 nodes", "nodes");
}

TEST_F(Claims, OfWorkThatGrowsWithTheSquare) {
  GltfBuilder builder;
  const int mesh = builder.quad();
  builder.json["meshes"][mesh]["primitives"][0]["attributes"]["JOINTS_0"] =
      builder.accessor<uint16_t>(std::vector<uint16_t>(16, 0), "VEC4");
  builder.json["meshes"][mesh]["primitives"][0]["attributes"]["WEIGHTS_0"] =
      builder.accessor<float>(std::vector<float>(16, 1), "VEC4");
  std::vector<int> joints;
  for (int i = 0; i < 5000; ++i) {
    builder.node({{"mesh", mesh}, {"skin", 0}});
    joints.push_back(i);
  }
  builder.append("skins", {{"joints", joints}});
  expect_refused(folder_.write("skins.gltf", builder.gltf()), "joints, more than the limit", "joints");

  GltfBuilder targets;
  const int morphed = targets.quad();
  targets.json["meshes"][morphed]["primitives"][0]["targets"] = std::vector<json>(20000, json::object());
  for (int i = 0; i < 5000; ++i) targets.node({{"mesh", morphed}});
  expect_refused(folder_.write("morph.gltf", targets.gltf()), "weights, more than the limit", "morph_weights");

  GltfBuilder endless;
  for (int i = 0; i < 150000; ++i) endless.node(json::object());
  endless.animation(endless.node({{"mesh", endless.quad()}}), "translation", {0, 1e9f}, {0, 0, 0, 1, 1, 1});
  expect_refused(folder_.write("endless.gltf", endless.gltf()), "vertices and nodes, more than the limit",
                 "posed_elements");
}

TEST_F(Claims, OfHugeTextures) {
  for (const auto& [width, height] : {std::pair{100000u, 100000u}, {0x7FFFFFFFu, 1u}, {1u, 20000u}})
    expect_image_refused(test::make_png(width, height, 8, 2, {}),
                         "(a side) has " + std::to_string(std::max(width, height)), "image_side");
  expect_image_refused(test::make_png(16384, 16384, 8, 2, {}), "has 268435456 texels", "image_texels");
  // SOI, a frame header of 65535 x 65535 texels in three components, EOI
  expect_image_refused(
      {0xFF, 0xD8, 0xFF, 0xC0, 0, 17, 8, 0xFF, 0xFF, 0xFF, 0xFF, 3, 1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0, 0xFF, 0xD9},
      "(a side) has 65535 texels", "image_side");
  std::vector<uint8_t> scans = {0xFF, 0xD8, 0xFF, 0xC2, 0, 11, 8, 0x20, 0, 0x20, 0, 1, 1, 0x11, 0};
  for (int i = 0; i < 5000; ++i) scans.insert(scans.end(), {0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0x7F});
  scans.insert(scans.end(), {0xFF, 0xD9});
  expect_image_refused(scans, "has 5000 scans", "jpeg_scans");
}

std::string u32(uint32_t value) {
  std::string text;
  for (uint32_t k = 0; k < 4; ++k) text += static_cast<char>(value >> (8 * k) & 255u);
  return text;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + u32(static_cast<uint32_t>(value.size())) + value;
}

std::string exr(int32_t right, int32_t bottom, const std::string& more = {}) {
  std::string channels;
  for (const char* name : {"B", "G", "R"}) channels += name + std::string(1, '\0') + u32(1) + u32(0) + u32(1) + u32(1);
  const std::string box = u32(0) + u32(0) + u32(static_cast<uint32_t>(right)) + u32(static_cast<uint32_t>(bottom));
  return "\x76\x2f\x31\x01" + u32(2) + attribute("channels", "chlist", channels + '\0') +
         attribute("compression", "compression", std::string(1, '\0')) + attribute("dataWindow", "box2i", box) +
         attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", u32(0x3F800000u)) +
         attribute("screenWindowCenter", "v2f", u32(0) + u32(0)) +
         attribute("screenWindowWidth", "float", u32(0x3F800000u)) + more + '\0';
}

TEST_F(Claims, OfHugeEnvironments) {
  const std::string begin = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  expect_environment_refused(begin + "-Y 100000 +X 100000\n", "(a side) has 100000 texels", "image_side");
  expect_environment_refused(begin + "-Y 16000 +X 16000\n", "has 256000000 texels", "float_texels");
  expect_environment_refused(begin + "-Y 99999999999999999999 +X 1\n", "without a line that gives its resolution", "");
  expect_environment_refused(exr(99999, 99999), "(a side) has 100000 texels", "image_side");
  expect_environment_refused(exr(2147483647, 2147483647), "(a side) has 2147483648 texels", "image_side");
  expect_environment_refused(exr(-2, 5), "broken header", "");
  expect_environment_refused(exr(12000, 12000), "has 144024001 texels", "float_texels");
  // OpenEXR reads as much as the type says, not as the size does, and allocates what it finds behind.
  const std::string channel = "A" + std::string(1, '\0') + u32(1) + u32(0) + u32(1) + u32(1);
  for (const std::string& lie :
       {attribute("more", "chlist", channel), attribute("window", "box2i", u32(0) + u32(0)),
        attribute("small", "preview", u32(1u << 15) + u32(1u << 15)), attribute("small", "preview", u32(1)),
        attribute("names", "stringvector", u32(0x7FFFFFFFu)), attribute("ids", "idmanifest", u32(0x7FFFFFFFu))})
    expect_environment_refused(exr(3, 3, lie), "broken header", "");
  expect_environment_refused("II*\0whatever", "is not a PNG, JPEG, Radiance HDR or OpenEXR file", "");
}

// Images of which none is as large as another in both directions are resampled to the size of the largest.
TEST_F(Claims, OfTexturePages) {
  GltfBuilder builder;
  const auto add = [&](uint32_t width, uint32_t height, const std::string& name) {
    const std::vector<uint8_t> png =
        test::make_png(width, height, 1, 0, std::vector<uint8_t>((width + 7) / 8 * height));
    folder_.write(name, {png.begin(), png.end()});
    builder.append("images", {{"uri", name}});
    const auto index = static_cast<int>(builder.json["images"].size()) - 1;
    builder.append("textures", {{"source", index}});
    builder.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", index}}}}}});
  };
  add(1, 1, "large.png");
  const std::unique_ptr<OIIO::ImageOutput> large = OIIO::ImageOutput::create("png");
  const std::vector<uint8_t> black(size_t{4096} * 4096);
  ASSERT_TRUE(
      large->open((folder_.path() / "large.png").string(), OIIO::ImageSpec(4096, 4096, 1, OIIO::TypeDesc::UINT8)) &&
      large->write_image(OIIO::TypeDesc::UINT8, black.data()) && large->close());
  for (uint32_t i = 1; i <= 100; ++i) add(i, 4300 - i, "thin" + std::to_string(i) + ".png");
  builder.node({{"mesh", builder.quad(0)}});
  expect_refused(folder_.write("pages.gltf", builder.gltf()), "texels, more than the limit", "page_texels");
}

}  // namespace
}  // namespace lightloom::scene
