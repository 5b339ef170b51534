#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/cli/program_fixture.hpp"
#include "tests/scene/gltf_builder.hpp"
#include "tests/support/peak_memory.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;

class LimitOptionsTest : public ProgramTest {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }
  std::string quad() {
    scene::test::GltfBuilder builder;
    builder.node({{"mesh", builder.quad()}});
    return write("quad.gltf", builder.gltf());
  }
  static std::string graph(const std::string& name) { return (source_dir() / "graphs" / (name + ".json")).string(); }
};

TEST_F(LimitOptionsTest, AreOptionsOfEveryCommandThatReadsScenes) {
  for (const char* command : {"render", "replay", "probe", "check", "plan", "scene", "study"}) {
    EXPECT_EQ(run({command, "--help"}), 0);
    EXPECT_THAT(out_, HasSubstr("--limit NAME=VALUE")) << command;
    EXPECT_THAT(out_, HasSubstr("--allow-outside")) << command;
  }
  EXPECT_EQ(run({"compare", "--help"}), 0);
  EXPECT_THAT(out_, HasSubstr("--limit NAME=VALUE"));
}

TEST_F(LimitOptionsTest, RefuseAndRaise) {
  const std::string scene = quad();
  for (const std::vector<std::string>& command : {std::vector<std::string>{"scene", scene},
                                                  {"plan", graph("paper"), "--scene", scene},
                                                  {"check", graph("paper"), "--scene", scene}}) {
    std::vector<std::string> refused = command;
    refused.insert(refused.end(), {"--limit", "vertices=3"});
    EXPECT_EQ(run(refused), 3) << command[0];
    EXPECT_THAT(err_, HasSubstr("has 4 vertices, more than the limit of 3")) << command[0];
    EXPECT_THAT(err_, HasSubstr("--limit vertices=4 lets it through")) << command[0];
    std::vector<std::string> raised = command;
    raised.insert(raised.end(), {"--limit", "vertices=4"});
    EXPECT_EQ(run(raised), 0) << err_;
  }
}

TEST_F(LimitOptionsTest, AreCheckedAsTheyAreRead) {
  const std::string scene = quad();
  EXPECT_EQ(run({"scene", scene, "--limit", "vertexes=4"}), 2);
  EXPECT_THAT(err_, HasSubstr("did you mean 'vertices'"));
  EXPECT_EQ(run({"scene", scene, "--limit", "vertices=many"}), 2);
  EXPECT_THAT(err_, HasSubstr("expected an integer from 1 to"));
  EXPECT_EQ(run({"scene", scene, "--limit", "vertices"}), 2);
}

TEST_F(LimitOptionsTest, AllowFilesOutside) {
  scene::test::GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  const std::string glb = builder.glb();
  write("data.bin", glb.substr(glb.find(std::string("BIN\0", 4)) + 4));
  nlohmann::json document = builder.finished();
  document["buffers"][0]["uri"] = "../data.bin";
  std::filesystem::create_directory(folder_ / "inner");
  const std::string file = write("inner/a.gltf", document.dump());
  EXPECT_EQ(run({"scene", file}), 3);
  EXPECT_THAT(err_, HasSubstr("buffers[0].uri: is '../data.bin', which lies outside of the folder"));
  EXPECT_THAT(err_, HasSubstr("--allow-outside"));
  EXPECT_EQ(run({"scene", file, "--allow-outside"}), 0) << err_;
}

/// The beginning of a PNG file of that size.
std::string png(uint32_t width, uint32_t height) {
  std::string bytes("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16);
  for (const uint32_t side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(side >> shift & 255u);
  return bytes + std::string("\x08\x02\0\0\0", 5);
}

TEST_F(LimitOptionsTest, HoldForComparedImages) {
  const std::string array(
      "\x93NUMPY\x01\x00\x76\x00{'descr': '<f4', 'fortran_order': False, 'shape': (60000, 60000, 4), }", 80);
  const std::vector<std::pair<std::string, std::string>> files = {
      {write("a.png", png(100000, 100000)), "(a side) has 100000 texels, more than the limit of 16384"},
      {write("b.png", png(16000, 16000)), "has 256000000 texels, more than the limit of 33554432"},
      {write("a.hdr", "#?RADIANCE\n\n-Y 200000 +X 200000\n"), "(a side) has 200000 texels"},
      {write("a.npy", array + std::string(48, ' ')), "its shape needs 57600000000"},
      {write("a.exr", "\x76\x2f\x31\x01garbage"), "is an OpenEXR file with a broken header"},
      {"/dev/zero", "is not a regular file"}};
  const test::Usage usage;
  for (const auto& [file, sentence] : files) {
    EXPECT_EQ(run({"compare", file, file}), 3) << file;
    EXPECT_THAT(err_, HasSubstr(sentence)) << file;
  }
  EXPECT_LT(usage.seconds(), 2);
  EXPECT_LT(usage.megabytes(), 300u);
}

TEST_F(LimitOptionsTest, GraphsOfAbsurdSizesAreRefused) {
  const test::Usage usage;
  for (const char* size : {"2147483648", "4294967296", "9223372036854775807", "1e300", "-1", "100000000"}) {
    const std::string number = size;
    const std::string text = R"({"lightloom_graph": 1, "view": {"width": )" + number + R"(, "height": )" + number +
                             R"(}, "passes": {}, "edges": [], "outputs": {}})";
    EXPECT_EQ(run({"plan", write("size.json", text)}), 3) << size;
    EXPECT_NE(err_, "");
  }
  EXPECT_EQ(run({"plan", write("deep.json", std::string(1 << 20, '['))}), 3);
  std::string values = "[0";
  for (int i = 0; i < 1'200'000; ++i) values += ",0";
  EXPECT_EQ(run({"check", write("wide.json", values + "]")}), 3);
  EXPECT_THAT(err_ + out_, HasSubstr("more values than are read"));
  EXPECT_EQ(run({"study", write("study.json", std::string(1 << 20, '{'))}), 3);
  const std::string pipe = (folder_ / "pipe.json").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const char* command : {"plan", "check", "study"}) {
    EXPECT_EQ(run({command, pipe}), 3) << command;
    EXPECT_THAT(err_ + out_, HasSubstr("is not a regular file")) << command;
  }
  EXPECT_LT(usage.seconds(), 10);
  EXPECT_LT(usage.megabytes(), 1200u);
}

}  // namespace
}  // namespace lightloom::cli
