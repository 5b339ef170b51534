// Runs that are interrupted and go on from their checkpoint, against runs that never stopped.
#include "framework/run/checkpoint.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/run/render.hpp"
#include "framework/scene/content_hash.hpp"
#include "passes/registry.hpp"
#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Thrown out of a run by its own callback, as a key press would stop it.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

class CheckpointTest : public ::testing::Test {
 protected:
  void SetUp() override {
    passes::register_builtin_passes(registry_);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("lightloom-checkpoint-" + std::to_string(getpid()) + "-" + std::string(test->name()));
    fs::create_directories(folder_);
    ordered_json paper = ordered_json::parse(read_text_file(source_dir() / "graphs/paper.json"));
    paper["view"] = {{"width", 40}, {"height", 30}};
    paper["trace"] = {{"width", 20}, {"height", 15}};
    paper["params"]["resolution"] = 24;
    std::ofstream(folder_ / "paper.json") << paper.dump(1);
    ordered_json mean = paper;
    mean["passes"]["mean"] = {{"type", "accumulate"},
                              {"in", {{"radiance", "trace.radiance"}, {"past", "mean.accumulation@1"}}}};
    mean["passes"]["modulate"]["in"] = {{"radiance", "mean.radiance"}, {"surface", "trace_surface.surface"}};
    mean["outputs"] = {{"radiance", "modulate.radiance"}, {"error", "mean.standard_error"}};
    mean.erase("variants");
    std::ofstream(folder_ / "mean.json") << mean.dump(1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  RenderRequest request(const char* graph, const std::string& out, uint32_t last_frame) const {
    RenderRequest made;
    made.graph = folder_ / graph;
    made.scene = source_dir() / "samples/scenes/atrium.scene.json";
    made.first_frame = 5;
    made.last_frame = made.first_frame + last_frame;
    made.out = folder_ / out;
    made.device.validate = true;
    return made;
  }

  /// Renders; `stop_after` frames of this call it is interrupted (0: never). Returns how many frames it rendered.
  uint32_t render_until(const RenderRequest& wanted, uint32_t stop_after = 0) {
    Diagnostics diagnostics;
    RenderSummary summary;
    uint32_t rendered = 0;
    try {
      const bool done = render(
          wanted, registry_,
          [&](uint32_t, uint32_t) {
            if (++rendered == stop_after) throw Interrupted();
          },
          diagnostics, summary);
      EXPECT_TRUE(done);
      for (const std::string& warning : summary.warnings) ADD_FAILURE() << warning;
    } catch (const Interrupted&) {
    }
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    return rendered;
  }

  std::string error_of(const RenderRequest& wanted) {
    Diagnostics diagnostics;
    RenderSummary summary;
    try {
      static_cast<void>(render(wanted, registry_, {}, diagnostics, summary));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      return error.what();
    }
    return {};
  }

  PassRegistry registry_;
  fs::path folder_;
};

TEST_F(CheckpointTest, AResumedRunHasTheBitsOfOneThatNeverStopped) {
  for (const char* graph : {"paper.json", "mean.json"}) {
    const std::string name = graph;
    RenderRequest whole = request(graph, name + "-whole", 20);
    whole.link.captures = {"merge.voxels", "distance.*"};
    ASSERT_EQ(render_until(whole), 21U);
    RenderRequest parts = whole;
    parts.out = folder_ / (name + "-parts");
    parts.checkpoint_every = 3;
    parts.resume = true;
    EXPECT_EQ(render_until(parts, 5), 5U) << "nothing to resume: starts at the first frame";
    EXPECT_EQ(render_until(parts, 15), 15U) << "from frame 3 of the run, beyond what the scene remembers";
    EXPECT_EQ(render_until(parts), 3U) << "from frame 18";
    EXPECT_EQ(test::first_difference(whole.out, parts.out), "");
    const auto record = ordered_json::parse(read_text_file(parts.out / "run.json"));
    EXPECT_EQ(record["resumed_at"], (std::vector<uint32_t>{8, 23}));
    EXPECT_EQ(record["frame_wall_ms"]["frames"].size(), 21U);
    EXPECT_FALSE(record["hoisted"].empty());
    for (const ordered_json& pass : record["passes"]) EXPECT_EQ(pass["frames_ms"].size(), 21U) << pass["pass"];
    for (const ordered_json& file : record["files"])
      EXPECT_TRUE(fs::exists(parts.out / file.get<std::string>())) << file;
  }
}

TEST_F(CheckpointTest, AFinishedRunCanBeMadeLonger) {
  RenderRequest shorter = request("mean.json", "run", 3);
  shorter.checkpoint_every = 100;
  EXPECT_EQ(render_until(shorter), 4U) << "the last frame has a checkpoint whatever its number";
  RenderRequest longer = request("mean.json", "run", 6);
  longer.resume = true;
  EXPECT_EQ(render_until(longer), 3U);
  EXPECT_EQ(render_until(request("mean.json", "whole", 6)), 7U);
  EXPECT_EQ(test::first_difference(folder_ / "whole", folder_ / "run"), "");
}

TEST_F(CheckpointTest, WhatIsDoneIsNotDoneAgain) {
  RenderRequest wanted = request("mean.json", "run", 2);
  wanted.checkpoint_every = 1;
  EXPECT_EQ(render_until(wanted), 3U);
  const auto before = test::run_files(wanted.out);
  wanted.resume = true;
  EXPECT_EQ(render_until(wanted), 0U);
  EXPECT_EQ(test::run_files(wanted.out), before);
  wanted.last_frame -= 1;
  EXPECT_NE(error_of(wanted).find("has 3 frames, more than the 2 asked for"), std::string::npos) << error_of(wanted);
}

TEST_F(CheckpointTest, WithoutResumeItIsNotUsed) {
  RenderRequest wanted = request("mean.json", "run", 3);
  wanted.checkpoint_every = 1;
  EXPECT_EQ(render_until(wanted, 2), 2U);
  EXPECT_EQ(render_until(wanted), 4U);
}

TEST_F(CheckpointTest, ACheckpointOfAnotherRunIsRefusedByName) {
  RenderRequest wanted = request("paper.json", "run", 1);
  wanted.checkpoint_every = 1;
  EXPECT_EQ(render_until(wanted), 2U);
  wanted.resume = true;
  const auto changed = [&](const std::function<void(RenderRequest&)>& change) {
    RenderRequest other = wanted;
    change(other);
    return error_of(other);
  };
  const auto expect_named = [](const std::string& error, const char* what) {
    EXPECT_NE(error.find("is of another run, which differs in"), std::string::npos) << error;
    EXPECT_NE(error.find(what), std::string::npos) << error;
  };
  expect_named(changed([](RenderRequest& other) { other.seed = 3; }), "seed (0 then, 3 now)");
  expect_named(changed([](RenderRequest& other) { other.link.view = {48, 30}; }), "view size (40x30 then, 48x30 now)");
  expect_named(changed([](RenderRequest& other) { other.link.sets = {{"paths", "2"}}; }), "plan of the graph (");
  expect_named(changed([](RenderRequest& other) { other.camera = "gallery"; }), "camera (nave then, gallery now)");
  expect_named(changed([](RenderRequest& other) { other.first_frame = 4; }), "first frame (5 then, 4 now)");
  expect_named(changed([](RenderRequest& other) { other.frames_per_second = 24; }), "frames a second (30.0 then");
  expect_named(changed([](RenderRequest& other) { other.dump_format = DumpFormat::npy; }), "dump format (exr then");
  ordered_json scene = ordered_json::parse(read_text_file(wanted.scene));
  scene["sun"]["angular_radius_degrees"] = 2;
  fs::copy(wanted.scene.parent_path(), folder_ / "scenes", fs::copy_options::recursive);
  std::ofstream(folder_ / "scenes/atrium.scene.json") << scene.dump(1);
  expect_named(changed([&](RenderRequest& other) { other.scene = folder_ / "scenes/atrium.scene.json"; }), "scene (");
  EXPECT_EQ(changed([](RenderRequest&) {}), "") << "the same run goes on";
}

TEST_F(CheckpointTest, ADamagedCheckpointIsRefused) {
  RenderRequest wanted = request("mean.json", "run", 1);
  wanted.checkpoint_every = 1;
  EXPECT_EQ(render_until(wanted), 2U);
  wanted.resume = true;
  const fs::path file = wanted.out / checkpoint_file();
  const std::string whole = read_text_file(file);
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  for (const std::string& text : {flipped, whole.substr(0, whole.size() / 2), std::string("no checkpoint")}) {
    std::ofstream(file, std::ios::binary) << text;
    EXPECT_NE(error_of(wanted).find("cannot be used"), std::string::npos) << error_of(wanted);
  }
}

TEST_F(CheckpointTest, WhatAKilledProcessLeftHalfWrittenIsRemoved) {
  RenderRequest wanted = request("mean.json", "run", 1);
  wanted.checkpoint_every = 1;
  EXPECT_EQ(render_until(wanted, 1), 1U);
  const fs::path dead = wanted.out / ".radiance.0001.exr.2147483646",
                 alive = wanted.out / (".a.png." + std::to_string(getpid())), own = wanted.out / ".notes.txt.12";
  for (const fs::path& file : {dead, alive, own}) std::ofstream(file) << "x";
  wanted.resume = true;
  EXPECT_EQ(render_until(wanted), 1U);
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(alive)) << "its process may still be writing";
  EXPECT_TRUE(fs::exists(own)) << "not ours";
}

TEST_F(CheckpointTest, TheContentHashOfASceneCoversWhatItNames) {
  fs::copy(source_dir() / "samples/scenes", folder_ / "scenes", fs::copy_options::recursive);
  const fs::path file = folder_ / "scenes/atrium.scene.json";
  const uint64_t original = scene::content_hash(file);
  EXPECT_EQ(original, scene::content_hash(source_dir() / "samples/scenes/atrium.scene.json"));
  const ordered_json scene = ordered_json::parse(read_text_file(file));
  const fs::path gltf = folder_ / "scenes" / scene["gltf"].get<std::string>();
  std::ofstream(gltf, std::ios::app) << "\n";
  EXPECT_NE(scene::content_hash(file), original);
}

}  // namespace
}  // namespace lightloom::run
