#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/scene/load_options.hpp"
#include "tests/scene/gltf_builder.hpp"
#include "tests/support/peak_memory.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::TemporaryFolder;
using ::testing::AnyOf;
using ::testing::HasSubstr;

std::string verdict(const std::filesystem::path& file, const LoadOptions& options = {}) {
  try {
    (void)load_scene(file, options);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
}

/// A quad whose bytes lie in a file of that name, and a textured one whose image does.
struct Scenes {
  json buffer, image;
  std::string bytes, png;
};

Scenes make_scenes() {
  Scenes scenes;
  GltfBuilder plain;
  plain.node({{"mesh", plain.quad()}});
  const std::string glb = plain.glb();
  scenes.buffer = plain.finished();
  scenes.bytes = glb.substr(glb.find(std::string("BIN\0", 4)) + 4);
  GltfBuilder textured;
  textured.append("images", {{"uri", "x.png"}});
  textured.append("textures", {{"source", 0}});
  textured.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  textured.node({{"mesh", textured.quad(0)}});
  scenes.image = textured.finished();
  const std::vector<uint8_t> png = test::make_png(1, 1, 8, 2, {1, 2, 3});
  scenes.png.assign(png.begin(), png.end());
  return scenes;
}

/// What happens where a buffer, and where an image, has that URI; the glTF files lie in `folder`/scene.
std::vector<std::string> verdicts(const TemporaryFolder& folder, Scenes scenes, const std::string& uri,
                                  const LoadOptions& options = {}) {
  scenes.buffer["buffers"][0]["uri"] = uri;
  scenes.image["images"][0]["uri"] = uri;
  return {verdict(folder.write("scene/buffer.gltf", scenes.buffer.dump()), options),
          verdict(folder.write("scene/image.gltf", scenes.image.dump()), options)};
}

class Paths : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "scene/inner");
    folder_.write("scene/inner/x.bin", scenes_.bytes);
    folder_.write("scene/inner/x.png", scenes_.png);
    folder_.write("outside.bin", scenes_.bytes);
    folder_.write("outside.png", scenes_.png);
  }
  TemporaryFolder folder_;
  Scenes scenes_ = make_scenes();
};

TEST_F(Paths, OutOfTheFolderAreRefused) {
  for (const char* uri : {"../../etc/passwd", "/etc/passwd", "../../../../../../../../etc/passwd",
                          "inner/../../outside.bin", "%2e%2e/outside.bin", "%2E%2E%2Foutside.bin", "..%2foutside.png",
                          "/dev/zero", "/dev/stdin", "/proc/self/mem", "/proc/self/environ", "..", "../outside.png"}) {
    for (const std::string& sentence : verdicts(folder_, scenes_, uri)) {
      EXPECT_THAT(sentence, HasSubstr("which lies outside of the folder")) << uri;
      EXPECT_THAT(sentence, AnyOf(HasSubstr("buffers[0].uri"), HasSubstr("images[0]"))) << uri;
    }
  }
}

TEST_F(Paths, WithASchemeOrControlCharactersAreRefused) {
  for (const char* uri :
       {"file:///etc/passwd", "file:/etc/passwd", "FILE:x.bin", "http://example.com/x.bin", "ftp:x", ":"})
    for (const std::string& sentence : verdicts(folder_, scenes_, uri))
      EXPECT_THAT(sentence, HasSubstr("expected a path relative to the file or a data URI")) << uri;
  for (const char* uri : {"inner/x.bin%00.png", "inner/%0ax.bin", ""})
    for (const std::string& sentence : verdicts(folder_, scenes_, uri)) EXPECT_NE(sentence, "") << uri;
}

TEST_F(Paths, InTheFolderAreRead) {
  EXPECT_EQ(verdicts(folder_, scenes_, "inner/x.bin")[0], "");
  EXPECT_EQ(verdicts(folder_, scenes_, "./inner/../inner/x.bin")[0], "");
  EXPECT_EQ(verdicts(folder_, scenes_, "../scene/inner/x.bin")[0], "");
  EXPECT_EQ(verdicts(folder_, scenes_, "inner/x.png")[1], "");
  EXPECT_EQ(verdicts(folder_, scenes_, (folder_.path() / "scene/inner/x.png").string())[1], "");
}

TEST_F(Paths, OutsideAreReadWhereThatIsAllowed) {
  const LoadOptions allowed{.limits = {}, .allow_outside = true};
  EXPECT_EQ(verdicts(folder_, scenes_, "../outside.bin", allowed)[0], "");
  EXPECT_EQ(verdicts(folder_, scenes_, "..%2Foutside.png", allowed)[1], "");
}

// A scene file is the main file: what lies below its folder may be shared by the models in folders beside each other.
TEST_F(Paths, BelowTheMainFilesFolderAreRead) {
  scenes_.buffer["buffers"][0]["uri"] = "../outside.bin";
  folder_.write("scene/buffer.gltf", scenes_.buffer.dump());
  const json scene = {{"lightloom_scene", 1}, {"gltf", "scene/buffer.gltf"}};
  EXPECT_EQ(verdict(folder_.write("main.scene.json", scene.dump())), "");
  const json elsewhere = {{"lightloom_scene", 1}, {"gltf", "../scene/buffer.gltf"}};
  std::filesystem::create_directory(folder_.path() / "other");
  EXPECT_THAT(verdict(folder_.write("other/main.scene.json", elsewhere.dump())),
              HasSubstr("lies outside of the folder"));
}

TEST_F(Paths, SymbolicLinksAreFollowedBeforeTheCheck) {
  std::filesystem::create_symlink("../outside.bin", folder_.path() / "scene/link.bin");
  std::filesystem::create_symlink("/etc", folder_.path() / "scene/etc");
  std::filesystem::create_symlink("inner/x.bin", folder_.path() / "scene/good.bin");
  EXPECT_THAT(verdicts(folder_, scenes_, "link.bin")[0], HasSubstr("lies outside of the folder"));
  EXPECT_THAT(verdicts(folder_, scenes_, "etc/passwd")[1], HasSubstr("lies outside of the folder"));
  EXPECT_EQ(verdicts(folder_, scenes_, "good.bin")[0], "");
}

TEST_F(Paths, PipesAndDevicesNeitherBlockNorEnd) {
  const std::string pipe = (folder_.path() / "scene/pipe.json").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const ::lightloom::test::Usage usage;
  for (const std::string& sentence : verdicts(folder_, scenes_, "pipe.json"))
    EXPECT_THAT(sentence, HasSubstr("is not a regular file"));
  const LoadOptions allowed{.limits = {}, .allow_outside = true};
  for (const char* device : {"/dev/zero", "/dev/tty", "/dev/random"})
    for (const std::string& sentence : verdicts(folder_, scenes_, device, allowed))
      EXPECT_THAT(sentence, AnyOf(HasSubstr("is not a regular file"), HasSubstr("cannot be opened"))) << device;
  EXPECT_THAT(verdict(pipe), HasSubstr("is not a regular file"));
  for (const json& scene :
       {json{{"lightloom_scene", 1}, {"gltf", "pipe.json"}}, json{{"lightloom_scene", 1}, {"gltf", "/dev/zero"}},
        json{{"lightloom_scene", 1}, {"gltf", "buffer.gltf"}, {"environment", {{"image", "pipe.json"}}}}})
    EXPECT_THAT(verdict(folder_.write("scene/a.scene.json", scene.dump())), HasSubstr("is not a regular file"));
  EXPECT_THROW((void)read_text_file(pipe), Error);
  EXPECT_THROW((void)read_text_file("/dev/zero"), Error);
  EXPECT_LT(usage.seconds(), 5);
}

}  // namespace
}  // namespace lightloom::scene
