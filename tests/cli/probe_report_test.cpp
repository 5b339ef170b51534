#include "framework/cli/probe_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

run::ProbedTexel floats(const std::string& port, const std::string& value, uint32_t age, std::vector<float> numbers) {
  run::ProbedTexel probed;
  probed.port = port;
  probed.value = value;
  probed.age = age;
  probed.desc = {numbers.size() == 1 ? Format::r32_sfloat : Format::rgba32_sfloat, Dimension::d2, {8, 8, 1}};
  probed.channels = numbers.size() == 1 ? std::vector<std::string>{port} : std::vector<std::string>{"R", "G", "B", "A"};
  probed.place = {3, 2, 0};
  image::HostImage texel{{probed.desc.format, Dimension::d2, {1, 1, 1}}, {}};
  texel.texels.resize(numbers.size() * sizeof(float));
  std::memcpy(texel.texels.data(), numbers.data(), texel.texels.size());
  probed.texel = texel;
  return probed;
}

run::ProbeReport sample_report() {
  const float infinity = std::numeric_limits<float>::infinity();
  run::ProbedTexel voxel = floats("voxels", "v.voxels", 0, {0});
  voxel.desc = {Format::r8_unorm, Dimension::d3, {8, 8, 8}};
  voxel.texel = image::HostImage{{Format::r8_unorm, Dimension::d3, {1, 1, 1}}, {std::byte{51}}};
  voxel.channels = {"voxels"};
  run::ProbedTexel unread = floats("rest", "p.rest", 0, {0});
  unread.texel.reset();
  unread.missing = "nobody reads it";
  run::ProbedPass pass{"p", "thing", "", {{"taps", int64_t{3}}, {"sharp", true}}, {}, {}, {}};
  pass.inputs = {floats("surface.a", "g.surface.a", 0, {1}), floats("surface.b", "g.surface.b", 0, {2}),
                 floats("past", "p.out", 1, {0.1f}), floats("past", "p.out", 2, {0}), floats("past", "p.out", 3, {0})};
  pass.outputs = {floats("out", "p.out", 0, {NAN, infinity, -infinity, 0.1f}), unread};
  pass.outputs[0].doc = "what p writes";
  pass.scratch = {voxel};
  run::ProbeReport report{.graph = "toy",
                          .view = {16, 16, 1},
                          .frames = {},
                          .culled = {{"c", "nobody needs it"}},
                          .bypassed = {},
                          .warnings = {}};
  report.frames.push_back({.frame = 7,
                           .time = 0.5,
                           .history_length = 1,
                           .point = glm::vec3(1, 2, 3),
                           .point_source = "g.surface.position",
                           .passes = {pass}});
  return report;
}

TEST(ProbeReport, TextMarksWhatIsNoNumberAndSaysWhatDidNotRun) {
  std::ostringstream out;
  print_probe(out, sample_report(), 6, 5);
  const std::string text = out.str();
  EXPECT_THAT(text, Not(HasSubstr("what p writes")));
  std::ostringstream explained;
  print_probe(explained, sample_report(), 6, 5, true);
  EXPECT_THAT(explained.str(), HasSubstr("what p writes\n"));
  for (const char* piece :
       {"pixel 6,5 of toy, view 16x16\n", "frame 7, 0.5 s; histories hold 1 earlier frame\n", "sees (1, 2, 3) m",
        "1. p (thing) taps=3 sharp=true\n", "in  surface = g.surface  as above\n",
        "in  past = p.out@1 (3, 2)  0.100000001\n", "in  past = p.out@2..3  zeros: there was no frame yet\n",
        "out out (3, 2)  R NaN  G Infinity  B -Infinity  A 0.100000001   <-- not finite\n",
        "out rest  no texel: nobody reads it\n", "tmp voxels voxel (3, 2, 0)  0.2 (51)\n",
        "did not run: c: nobody needs it\n"})
    EXPECT_THAT(text, HasSubstr(piece));
}

TEST(ProbeReport, JsonHasAllNumbersExactly) {
  const auto json = nlohmann::ordered_json::parse(probe_json(sample_report(), 6, 5).dump());
  EXPECT_EQ(json["pixel"], (std::vector<uint32_t>{6, 5}));
  EXPECT_EQ(json["culled"][0]["pass"], "c");
  const auto& frame = json["frames"][0];
  EXPECT_EQ(frame["point"], (std::vector<double>{1, 2, 3}));
  const auto& pass = frame["passes"][0];
  EXPECT_EQ(pass["params"]["taps"], 3);
  EXPECT_EQ(pass["params"]["sharp"], true);
  EXPECT_EQ(pass["inputs"].size(), 5U) << "nothing is left out";
  EXPECT_EQ(pass["inputs"][2]["age"], 1);
  EXPECT_EQ(pass["inputs"][2]["channels"]["past"].get<float>(), 0.1f);
  const auto& out = pass["outputs"][0];
  EXPECT_EQ(out["channels"]["R"], "NaN");
  EXPECT_EQ(out["channels"]["G"], "Infinity");
  EXPECT_EQ(out["channels"]["B"], "-Infinity");
  EXPECT_EQ(out["finite"], false);
  EXPECT_EQ(pass["outputs"][1]["missing"], "nobody reads it");
  EXPECT_FALSE(pass["outputs"][1].contains("channels"));
  EXPECT_EQ(pass["scratch"][0]["bytes"]["voxels"], 51);
  EXPECT_EQ(pass["scratch"][0]["texel"], (std::vector<uint32_t>{3, 2, 0}));
}

class ProbeAndReplay : public ProgramTest {
 protected:
  const std::string source_ = source_dir().string();
  const std::string graph_ = source_ + "/graphs/paper.json";
  const std::vector<std::string> frame_ = {"--scene",      source_ + "/samples/scenes/atrium.scene.json",
                                           "--size",       "32x24",
                                           "--trace-size", "16x12",
                                           "--set",        "resolution=16",
                                           "--frames",     "0..1"};

  std::vector<std::string> with_frame(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), frame_.begin(), frame_.end());
    return arguments;
  }
};

TEST_F(ProbeAndReplay, TheCommandsAgreeOnAPixel) {
  const std::string run_folder = (folder_ / "run").string();
  ASSERT_EQ(run(with_frame({"render", graph_, "--dump", "*", "--out", run_folder})), 0) << err_;
  ASSERT_EQ(run(with_frame({"probe", graph_, "20,9", "--json"})), 0) << err_;
  const auto json = nlohmann::ordered_json::parse(out_);
  ASSERT_EQ(json["frames"].size(), 1U);
  EXPECT_EQ(json["frames"][0]["frame"], 1);
  EXPECT_EQ(json["frames"][0]["passes"].back()["pass"], "tonemap");
  EXPECT_FALSE(std::filesystem::exists("out/paper")) << "no run folder is written";
  ASSERT_EQ(run({"replay", run_folder, "tonemap", "denoise_*"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("tonemap.image  equals the dump bit for bit"));
  EXPECT_THAT(out_, HasSubstr("denoise_box_y.radiance  equals the dump bit for bit"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run/replay/dumps/0001/tonemap.image.exr"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run/replay/image.0001.png"));

  ASSERT_EQ(run({"replay", run_folder, "tonemap", "--set", "exposure=3"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("not held against the dumps, as this has changed"));
  EXPECT_THAT(out_, Not(HasSubstr("texels differ")));
  ASSERT_EQ(run({"replay", run_folder, "tonemap", "--set", "exposure=3", "--compare", "--repeat", "2"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("texels differ, most at ("));
  EXPECT_THAT(out_, HasSubstr("median of 2 runs"));

  // A dump that is not what the run had: nothing else has changed, so that is a failure.
  std::filesystem::copy_file(folder_ / "run/dumps/0000/modulate.radiance.exr",
                             folder_ / "run/dumps/0001/modulate.radiance.exr",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(run({"replay", run_folder, "modulate"}), 1);
  EXPECT_THAT(out_, HasSubstr("texels differ"));
  EXPECT_THAT(err_, HasSubstr("although nothing is known to have changed"));
}

TEST_F(ProbeAndReplay, WrongUsageIsNamed) {
  EXPECT_EQ(run({"probe", graph_}), 2);
  EXPECT_THAT(err_, AllOf(HasSubstr("argument X,Y is missing"), HasSubstr("option '--scene' is missing")));
  for (const char* pixel : {"3", "3,", "a,b", "3,4,5", "-1,2"}) {
    EXPECT_EQ(run(with_frame({"probe", graph_, pixel})), 2) << pixel;
  }
  EXPECT_EQ(run(with_frame({"probe", graph_, "32,0"})), 2);
  EXPECT_THAT(err_, HasSubstr("pixel 32,0 lies outside the view of 32x24 pixels"));
  EXPECT_EQ(run({"replay", (folder_ / "nowhere").string(), "*"}), 3);
  EXPECT_THAT(err_, HasSubstr("no run.json"));
  EXPECT_EQ(run({"replay", folder_.string()}), 2);
  EXPECT_THAT(err_, HasSubstr("argument PASS is missing"));
}

}  // namespace
}  // namespace lightloom::cli
