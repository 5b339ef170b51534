#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/base/text.hpp"
#include "framework/cli/text_layout.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

const std::string kSource = source_dir().string();
const std::string kGraph = kSource + "/graphs/paper.json";
const std::string kScene = kSource + "/samples/scenes/atrium.scene.json";

class Commands : public ProgramTest {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
};

TEST_F(Commands, help_and_version_go_to_standard_output) {
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_THAT(out_, StartsWith("lightloom 0."));
  for (const std::string command : {"render", "probe", "replay", "check", "plan", "passes", "schema", "scene", "brdf",
                                    "compare", "devices", "completion"}) {
    EXPECT_EQ(run({command, "--help"}), 0);
    EXPECT_THAT(out_, HasSubstr("Usage: lightloom " + command));
    EXPECT_EQ(err_, "");
    for (const std::string& line : split(out_, '\n')) EXPECT_LE(display_width(line), 100u) << line;
  }
  EXPECT_EQ(run({"--help"}), 0);
  for (const std::string& line : split(out_, '\n')) EXPECT_LE(display_width(line), 100u) << line;
}

TEST_F(Commands, wrong_usage_names_every_problem_and_exits_with_2) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"render"}), 2);
  EXPECT_THAT(err_, AllOf(HasSubstr("argument GRAPH is missing"), HasSubstr("option '--scene' is missing")));
  EXPECT_EQ(out_, "");
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--frames", "0..4294967295", "--size=5", "--fps=0"}), 2);
  EXPECT_THAT(err_, AllOf(HasSubstr("'--frames'"), HasSubstr("'--size'"), HasSubstr("'--fps'")));
  EXPECT_EQ(run({"passes", "gahter"}), 2);
  EXPECT_THAT(err_, HasSubstr("did you mean 'gather'?"));
}

TEST_F(Commands, passes_lists_every_type_and_describes_one) {
  EXPECT_EQ(run({"passes"}), 0);
  for (const std::string& name : registry_.names()) EXPECT_THAT(out_, HasSubstr(name + " "));
  for (const std::string& name : registry_.names()) {
    EXPECT_EQ(run({"passes", name}), 0);
    const PassType& type = *registry_.find(name);
    EXPECT_THAT(out_, StartsWith(name));
    for (const Port& port : type.ports) EXPECT_THAT(out_, HasSubstr(port.name));
    for (const Param& param : type.params) EXPECT_THAT(out_, HasSubstr(param.name + " = "));
  }
}

TEST_F(Commands, passes_as_json_hold_the_whole_tables) {
  ASSERT_EQ(run({"passes", "--json"}), 0);
  const nlohmann::json json = nlohmann::json::parse(out_);
  ASSERT_THAT(json["passes"], SizeIs(registry_.names().size()));
  for (const nlohmann::json& pass : json["passes"]) {
    const PassType& type = *registry_.find(pass["type"].get<std::string>());
    EXPECT_THAT(pass["ports"], SizeIs(type.ports.size()));
    EXPECT_THAT(pass["params"], SizeIs(type.params.size()));
  }
  ASSERT_EQ(run({"passes", "voxelize", "--json"}), 0);
  const nlohmann::json voxelize = nlohmann::json::parse(out_)["passes"].at(0);
  EXPECT_EQ(voxelize["params"][2]["name"], "resolution");
  EXPECT_EQ(voxelize["params"][2]["minimum"], 8);
}

TEST_F(Commands, check_lists_every_problem_with_its_place_and_exits_with_3) {
  const std::string graph =
      file("bad.json",
           "{\n"
           "  \"lightloom\": 1,\n"
           "  \"passes\": {\n"
           "    \"gather\": { \"type\": \"gahter\" },\n"
           "    \"tonemap\": { \"type\": \"tonemap\", \"in\": { \"radianc\": \"gather.surface.albedo\" } }\n"
           "  },\n"
           "  \"outputs\": { \"image\": \"tonemap.image\" },\n"
           "  \"variants\": { \"v\": { \"disable\": [\"denoise\"] } }\n"
           "}\n");
  EXPECT_EQ(run({"check", graph}), 3);
  EXPECT_THAT(out_, HasSubstr(graph + ":4:25: error[unknown-pass-type]"));
  EXPECT_THAT(out_, HasSubstr(graph + ":5:45: error[unknown-input]"));
  EXPECT_THAT(out_, HasSubstr(graph + ":8:36: error[no-match]"));
  EXPECT_EQ(run({"check", graph, "--json"}), 3);
  const nlohmann::json json = nlohmann::json::parse(out_);
  EXPECT_EQ(json["files"][0]["ok"], false);
  EXPECT_EQ(json["files"][0]["problems"][0]["line"], 4);
  EXPECT_EQ(json["files"][0]["problems"][0]["column"], 25);
}

TEST_F(Commands, check_of_several_files_goes_on_after_a_bad_one) {
  EXPECT_EQ(run({"check", "no/such.json", file("cut.json", "{ \"lightloom\": 1, "), kGraph}), 3);
  EXPECT_THAT(out_, HasSubstr("no/such.json"));
  EXPECT_THAT(out_, HasSubstr("cut.json:1:"));
  EXPECT_THAT(out_, HasSubstr(kGraph + ": no problems"));
}

TEST_F(Commands, graphs_that_ship_have_no_problem) {
  std::vector<std::string> line = {"check"};
  for (const char* folder : {"/graphs", "/samples/graphs"}) {
    for (const auto& entry : std::filesystem::directory_iterator(kSource + folder)) {
      if (entry.path().extension() == ".json") line.push_back(entry.path().string());
    }
  }
  ASSERT_GE(line.size(), 3u);
  EXPECT_EQ(run(line), 0) << out_;
}

TEST_F(Commands, plan_prints_what_runs_and_what_does_not) {
  EXPECT_EQ(run({"plan", kGraph}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("voxelize_dynamic"), HasSubstr("denoise_tangent"), HasSubstr("tonemap")));
  EXPECT_THAT(err_, HasSubstr("unit cube"));
  const std::string whole = out_;
  EXPECT_EQ(run({"plan", kGraph, "--disable", "denoise_*", "--scene", kScene}), 0);
  EXPECT_NE(out_, whole);
  EXPECT_EQ(err_, "");
  EXPECT_THAT(out_, AllOf(HasSubstr(", 1 of them once,"), HasSubstr("what it reads never changes: static geometry")));
  EXPECT_EQ(run({"plan", kGraph, "--disable", "denoise_*", "--scene", kScene, "--no-hoist"}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr(", 0 of them once,"), HasSubstr("voxelize_static")));
}

TEST_F(Commands, plan_shows_the_memory_and_verifies) {
  EXPECT_EQ(run({"plan", kGraph, "--scene", kScene, "--size", "64x48", "--set", "resolution=16"}), 0);
  EXPECT_THAT(out_, Not(HasSubstr("takes over the memory")));
  EXPECT_EQ(
      run({"plan", kGraph, "--scene", kScene, "--size", "64x48", "--set", "resolution=16", "--memory", "--verify"}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("takes over the memory of"), HasSubstr("no sharing needs less than"),
                          HasSubstr("verified over 12 frames"), HasSubstr("no violation")));
}

TEST_F(Commands, a_mistake_in_an_option_is_usage_and_one_in_the_graph_is_invalid_input) {
  EXPECT_EQ(run({"plan", kGraph, "--set", "resolutio=3"}), 2);
  EXPECT_THAT(err_, HasSubstr("did you mean 'resolution'?"));
  EXPECT_EQ(run({"plan", kGraph, "--variant", "nix"}), 2);
  EXPECT_EQ(run({"plan", kGraph, "--disable", "nix"}), 2);
  EXPECT_EQ(run({"plan", kGraph, "--swap", "trace=nix"}), 2);
  EXPECT_EQ(run({"plan", kGraph, "--set", "resolution=100000"}), 2);
  EXPECT_EQ(run({"plan", kGraph, "--disable", "gather"}), 3);
  EXPECT_THAT(err_, AllOf(HasSubstr("no-bypass"), HasSubstr("gather"), HasSubstr("trace_surface")));
  EXPECT_EQ(run({"plan", "no/such.json"}), 3);
  EXPECT_EQ(out_, "");
}

TEST_F(Commands, scene_describes_a_good_one) {
  EXPECT_EQ(run({"scene", kScene}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("triangles"), HasSubstr("camera"), HasSubstr("features"), HasSubstr("sun")));
  ASSERT_EQ(run({"scene", kScene, "--json"}), 0);
  const nlohmann::json json = nlohmann::json::parse(out_);
  EXPECT_GT(json["triangles"], 1000);
  EXPECT_EQ(json["cameras"][0], "nave");
  EXPECT_EQ(json["features"]["dynamic"], true);
}

TEST_F(Commands, scene_refuses_a_bad_one_in_one_sentence) {
  for (const std::string& name :
       {std::string("no/such.gltf"), file("cut.gltf", "{ \"asset\": { \"version\": \"2.0\" }, \"nodes\": ["),
        file("not.glb", "glTF"), file("bad.scene.json", "{ \"lightloom_scene\": 1 }")}) {
    EXPECT_EQ(run({"scene", name}), 3) << name;
    EXPECT_EQ(out_, "");
    EXPECT_THAT(err_, StartsWith("error: ")) << name;
    EXPECT_THAT(err_, HasSubstr(std::filesystem::path(name).filename().string()));
  }
}

TEST_F(Commands, a_render_that_cannot_begin_leaves_nothing) {
  const std::string out = (folder_ / "run").string();
  EXPECT_EQ(run({"render", kGraph, "--scene", "no/such.gltf", "--out", out}), 3);
  EXPECT_EQ(run({"render", "no/such.json", "--scene", kScene, "--out", out}), 3);
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--out", out, "--camera", "nobody"}), 3);
  EXPECT_THAT(err_, HasSubstr("nave"));
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--out", out, "--set", "nothing=1"}), 2);
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--out", out, "--device", "no such device"}), 4);
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--out", out, "--camera-path", "no/such.json"}), 3);
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--out", out, "--camera-path", file("path.json", "{}")}), 3);
  EXPECT_THAT(err_, HasSubstr("path.json:1:1: lightloom_camera_path is missing"));
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--out", out, "--dump-format", "png"}), 2);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Commands, render_fills_the_run_folder_and_the_validation_layers_are_silent) {
  const std::string out = (folder_ / "run").string();
  ASSERT_EQ(run({"render", kGraph, "--scene", kScene, "--size", "32x24", "--set", "resolution=16", "--frames", "1..2",
                 "--dump", "distance.*", "--dump", "gather.surface.normal", "--validate", "--out", out}),
            0)
      << err_;
  EXPECT_EQ(err_, "");
  EXPECT_THAT(out_, AllOf(StartsWith("2 frames in " + out), HasSubstr("image.0002.png")));
  for (const char* name :
       {"radiance.0001.exr", "image.0001.png", "radiance.0002.exr", "image.0002.png", "run.json", "plan.json",
        "dumps/0001/distance.distance.npy", "dumps/0002/gather.surface.normal.exr", "dumps/index.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / name)) << name;
  }
  std::ifstream stream(folder_ / "run/run.json");
  const nlohmann::json record = nlohmann::json::parse(stream);
  EXPECT_EQ(record["command_line"][0], "lightloom");
  EXPECT_EQ(record["command_line"][1], "render");
  EXPECT_EQ(record["validation"], true);
}

TEST_F(Commands, devices_lists_what_rendering_uses) {
  EXPECT_EQ(run({"devices"}), 0);
  EXPECT_THAT(out_, HasSubstr("yes"));
  ASSERT_EQ(run({"devices", "--json"}), 0);
  const nlohmann::json devices = nlohmann::json::parse(out_)["devices"];
  ASSERT_THAT(devices, Not(IsEmpty()));
  EXPECT_TRUE(devices[0].contains("usable"));
  ASSERT_TRUE(devices[0].contains("ray_queries"));
  EXPECT_EQ(devices[0]["ray_queries"], devices[0]["ray_queries_missing"] == "");
}

TEST_F(Commands, a_device_that_lacks_what_a_pass_needs_is_named_and_nothing_is_written) {
  ASSERT_EQ(run({"devices", "--json"}), 0);
  for (const nlohmann::json& device : nlohmann::json::parse(out_)["devices"])
    if (device["ray_queries"] == true) GTEST_SKIP() << "a device here has ray queries";
  const std::string out = (folder_ / "run").string();
  EXPECT_EQ(run({"render", kGraph, "--scene", kScene, "--swap", "trace=ray_query_path_trace", "--out", out}), 4);
  EXPECT_THAT(err_, AllOf(HasSubstr("pass 'trace' (ray_query_path_trace) needs VK_KHR_ray_query"), HasSubstr("hint: "),
                          HasSubstr("reference_path_trace")));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Commands, completion_knows_the_real_commands) {
  EXPECT_EQ(run({"completion", "bash"}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("--scene"), HasSubstr("voxel_path_trace"), HasSubstr("complete -o filenames")));
  EXPECT_EQ(run({"completion", "fish"}), 2);
}

TEST_F(Commands, output_that_cannot_be_written_is_a_failed_run) {
  std::ostringstream err;
  std::ostream closed(nullptr);
  const CommandContext context{closed, err, false, registry_};
  EXPECT_EQ(run_program({"passes"}, context), ExitCode::run_failed);
  EXPECT_THAT(err.str(), HasSubstr("standard output"));
}

}  // namespace
}  // namespace lightloom::cli
