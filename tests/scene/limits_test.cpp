#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "framework/base/error.hpp"
#include "framework/scene/camera_path.hpp"
#include "framework/scene/content_hash.hpp"
#include "framework/scene/load_options.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::TemporaryFolder;
using ::testing::HasSubstr;

void write_image(const std::filesystem::path& file, int width, int height, bool floats) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
  OIIO::ImageSpec spec(width, height, 3, floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("jpeg:progressive", 1);
  const std::vector<float> samples(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 0.5f);
  ASSERT_TRUE(output && output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && output->close());
}

/// A scene file that uses something of each limit: instances, a skin, morph targets, an animation, textures, an
/// environment.
std::filesystem::path rich_scene(const TemporaryFolder& folder) {
  write_image(folder.path() / "a.jpg", 24, 16, false);
  write_image(folder.path() / "b.jpg", 8, 8, false);
  write_image(folder.path() / "sky.hdr", 8, 4, true);
  GltfBuilder builder;
  builder.append("images", {{"uri", "a.jpg"}});
  builder.append("images", {{"uri", "b.jpg"}});
  builder.append("textures", {{"source", 0}});
  builder.append("textures", {{"source", 1}});
  builder.append("materials", {{"name", "painted"},
                               {"emissiveTexture", {{"index", 1}}},
                               {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  const int mesh = builder.quad(0);
  json& primitive = builder.json["meshes"][mesh]["primitives"][0];
  primitive["attributes"]["JOINTS_0"] =
      builder.accessor<uint16_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] =
      builder.accessor<float>({1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 3, 0, 0}, "VEC4");
  primitive["targets"] = {{{"POSITION", builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
  builder.node({{"mesh", mesh}, {"skin", 0}});
  builder.node({{"children", {2}}});
  builder.node({{"translation", {0, 5, 0}}});
  builder.append("skins", {{"joints", {1, 2}}});
  builder.animation(2, "translation", {0, 1}, {0, 5, 0, 0, 5, 4});
  folder.write("rich.gltf", builder.gltf());
  const json scene = {{"lightloom_scene", 1},
                      {"gltf", "rich.gltf"},
                      {"instances", {{{"gltf", "rich.gltf"}, {"translation", {3, 0, 0}}}}},
                      {"environment", {{"image", "sky.hdr"}}}};
  return folder.write("rich.scene.json", scene.dump());
}

/// The error's sentence, or "".
std::string load_with(const std::filesystem::path& file, const LimitInfo& info, uint64_t value, std::string& hint) {
  LoadOptions options;
  options.limits.*info.value = value;
  try {
    (void)load_scene(file, options);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    hint = error.hint();
    return error.what();
  }
}

// The smallest value that lets the scene through is found by bisection; one less must be refused by that very limit,
// with the option that raises it.
TEST(Limits, EachIsWhatRefusesAndCanBeRaised) {
  const TemporaryFolder folder;
  const std::filesystem::path file = rich_scene(folder);
  ASSERT_EQ(load_scene(file).triangles.size(), 4u);
  for (const LimitInfo& info : limit_table()) {
    SCOPED_TRACE(std::string(info.name));
    std::string hint;
    uint64_t refused = 0, loads = Limits{}.*info.value;
    ASSERT_EQ(load_with(file, info, loads, hint), "");
    while (loads - refused > 1) {
      const uint64_t middle = refused + (loads - refused) / 2;
      (load_with(file, info, middle, hint).empty() ? loads : refused) = middle;
    }
    ASSERT_GT(loads, 1u) << "nothing in the scene is held against this limit";
    const std::string sentence = load_with(file, info, loads - 1, hint);
    EXPECT_THAT(sentence, HasSubstr("more than the limit of " + std::to_string(loads - 1)));
    EXPECT_THAT(sentence, HasSubstr(" " + std::string(info.noun)));
    EXPECT_THAT(hint, HasSubstr("--limit " + std::string(info.name) + "="));
    EXPECT_LE(loads, info.most);
    EXPECT_LE(Limits{}.*info.value, info.most);
  }
}

TEST(Limits, AreSetByName) {
  Limits limits;
  EXPECT_EQ(set_limit(limits, "nodes", "12"), "");
  EXPECT_EQ(limits.nodes, 12u);
  EXPECT_THAT(set_limit(limits, "node", "12"), HasSubstr("did you mean 'nodes'"));
  for (const char* value : {"", "0", "-1", "1e6", "99999999999999999999", "5 "})
    EXPECT_THAT(set_limit(limits, "nodes", value), HasSubstr("expected an integer from 1 to")) << value;
  EXPECT_THAT(set_limit(limits, "json_depth", "1001"), HasSubstr("from 1 to 1000"));
  EXPECT_EQ(limits.nodes, 12u);
}

TEST(Limits, HoldForCameraPaths) {
  const TemporaryFolder folder;
  json path = {{"lightloom_camera_path", 1}, {"keyframes", json::array()}};
  for (int i = 0; i < 20; ++i)
    path["keyframes"].push_back({{"time", i}, {"position", {i, 0, 0}}, {"target", {i, 0, -1}}});
  const std::filesystem::path file = folder.write("path.json", path.dump());
  EXPECT_EQ(read_camera_path(file).keys.size(), 20u);
  Limits limits;
  limits.json_values = 100;
  EXPECT_THROW((void)read_camera_path(file, limits), Error);
  limits = {};
  limits.json_bytes = 100;
  EXPECT_THROW((void)read_camera_path(file, limits), Error);
}

// What a scene file names is hashed for the record; a string that merely looks like a path is not read.
TEST(ContentHash, ReadsWhatTheLoaderWouldRead) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}, {"name", "secret.txt"}});
  builder.json["images"] = {{{"uri", "../outside.png"}}, {{"uri", "/dev/zero"}}};
  folder.write("secret.txt", "what is not named by a uri");
  const std::filesystem::path file = folder.write("scene.gltf", builder.gltf());
  const FileContents files = content_files(file);
  EXPECT_EQ(files.size(), 1u);
  EXPECT_TRUE(files.contains(file));
  const std::string deep(1 << 20, '[');
  const std::filesystem::path nested = folder.write("deep.gltf", "{\"uri\":" + deep);
  EXPECT_THROW((void)content_hash(nested), Error);
}

}  // namespace
}  // namespace lightloom::scene
