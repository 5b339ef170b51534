// Files are written while the next frame renders; in bits and files nothing else follows from it.
#include "framework/run/frame_loop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "framework/base/error.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/run/checkpoint.hpp"
#include "framework/run/compile_graph.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/run_files.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// `count` counts frames by its history; the host pass `stage` gives the frame's number, and tells when it runs.
constexpr const char* kGraph = R"({ "lightloom": 1, "name": "loop",
  "view": { "width": 9, "height": 4 }, "trace": { "width": 9, "height": 4 },
  "passes": {
    "stage": { "type": "host_stage" },
    "count": { "type": "test_counter", "in": { "previous": "count.count@1" } },
    "sum": { "type": "test_counter", "in": { "previous": "stage.y" } }
  },
  "outputs": { "count": "count.count", "earlier": "sum.count@1" } })";

template <class Condition>
bool happens_within(std::chrono::seconds limit, const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

class FrameLoopTest : public test::DeviceTest {
 protected:
  void SetUp() override {
    test::DeviceTest::SetUp();
    folder_ = fs::temp_directory_path() / ("lightloom-frame-loop-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    PassType stage;
    stage.name = "host_stage";
    stage.doc = "For tests.";
    stage.ports = {toy::image_port("y", Direction::out)};
    stage.ports[0].access = Access::transfer_write;
    stage.reads = FrameState::time;
    stage.host = [this](HostContext& context) {
      rendering_ = context.scene().frame;
      if (in_stage_) in_stage_(context.scene().frame);
      const std::vector<float> numbers(36, static_cast<float>(context.scene().frame));
      std::memcpy(context.output("y", "").texels.data(), numbers.data(), numbers.size() * sizeof(float));
    };
    registry_.add(stage);
    PassType counter = toy::one_shader_type(
        "test_counter", {toy::image_port("previous", Direction::in), toy::image_port("count", Direction::out)},
        "test_counter.comp", "count");
    counter.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
    registry_.add(counter);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Executor executor(const std::vector<std::string>& captures = {"*"}) {
    LinkOptions link_options;
    link_options.captures = captures;
    Diagnostics diagnostics;
    const auto spec = parse_graph(kGraph, "loop.json", diagnostics);
    const auto graph = link(spec.value(), registry_, link_options, link_environment(&scene_), diagnostics);
    ExecutorOptions options;
    options.shaders = default_shader_folders();
    options.shaders.sources.push_back(source_dir() / "tests/passes/shaders");
    return {device(), compile(graph.value()), scene_, options};
  }

  static FrameLoopOptions options(uint32_t frames) {
    FrameLoopOptions made;
    made.total = frames;
    made.describe = [](const FrameResult& frame) { return ordered_json{{"frame", frame.frame}}; };
    return made;
  }

  /// Renders into a folder of that name and finishes it.
  void render(const std::string& name, const FrameLoopOptions& loop) {
    Executor frames = executor();
    RunFolder folder(folder_ / name);
    RunProgress progress;
    render_frames(frames, folder, progress, loop);
    EXPECT_EQ(progress.frames(), loop.total);
    EXPECT_EQ(progress.pass_times.size(), loop.total);
    folder.finish({{"lightloom", "test"}});
  }

  scene::Scene scene_ = toy::one_quad();
  PassRegistry registry_;
  fs::path folder_;
  std::atomic<uint32_t> rendering_{0};  ///< frame that the host pass saw last
  std::function<void(uint32_t)> in_stage_;
};

TEST_F(FrameLoopTest, AFrameIsWrittenWhileTheNextOneRenders) {
  constexpr uint32_t kFrames = 6;
  FrameLoopOptions loop = options(kFrames);
  std::atomic<uint32_t> overlapped{0};
  // Were one done after the other, this would wait in vain.
  loop.describe = [&](const FrameResult& frame) {
    if (frame.frame + 1 < kFrames && happens_within(std::chrono::seconds(20), [&] { return rendering_ > frame.frame; }))
      ++overlapped;
    return ordered_json{{"frame", frame.frame}};
  };
  render("run", loop);
  EXPECT_EQ(overlapped, kFrames - 1);
}

TEST_F(FrameLoopTest, ASlowDiskAndASlowFrameTakeLessThanBothTogether) {
  constexpr uint32_t kFrames = 8;
  constexpr std::chrono::milliseconds kEach{40};
  in_stage_ = [&](uint32_t) { std::this_thread::sleep_for(kEach); };
  FrameLoopOptions loop = options(kFrames);
  loop.describe = [&](const FrameResult&) {
    std::this_thread::sleep_for(kEach);
    return ordered_json{};
  };
  Executor frames = executor({});
  RunFolder folder(folder_ / "run");
  RunProgress progress;
  const auto start = std::chrono::steady_clock::now();
  render_frames(frames, folder, progress, loop);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  double rendering = 0;
  for (const double frame : progress.wall_milliseconds) rendering += frame;
  EXPECT_GE(rendering, 40.0 * kFrames);
  EXPECT_LT(took.count(), rendering + 40.0 * kFrames - 100) << "less than one after the other";
}

TEST_F(FrameLoopTest, TheFilesAreThoseOfFramesWrittenOneAfterAnother) {
  constexpr uint32_t kFrames = 7;
  render("overlapped", options(kFrames));
  Executor frames = executor();
  RunFolder folder(folder_ / "one-by-one");
  for (uint32_t frame = 0; frame < kFrames; ++frame)
    folder.write_frame(frames.plan().graph, frames.run_frame(frame), {{"frame", frame}});
  folder.finish({{"lightloom", "test"}});
  EXPECT_EQ(test::first_difference(folder_ / "one-by-one", folder_ / "overlapped"), "");
  EXPECT_EQ(test::run_files(folder_ / "overlapped").size(), kFrames * (2 + 3 + 1) + 1U);
}

TEST_F(FrameLoopTest, AWriterThatIsSlowerThanTheDeviceIsWaitedFor) {
  FrameLoopOptions loop = options(30);
  uint32_t furthest = 0;
  loop.describe = [&](const FrameResult& frame) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    furthest = std::max(furthest, rendering_ - frame.frame);
    return ordered_json{};
  };
  Executor frames = executor();
  RunFolder folder(folder_ / "run");
  RunProgress progress;
  render_frames(frames, folder, progress, loop);
  EXPECT_GE(furthest, 1U);
  EXPECT_LE(furthest, 2U) << "frames ahead of the one that is being written";
  EXPECT_LE(frames.readback_sets(), 3U) << "memory must not grow with the number of frames";
}

TEST_F(FrameLoopTest, ChosenFramesAreWrittenAndHaveTheBitsOfARunThatWritesAll) {
  constexpr uint32_t kFrames = 12;
  render("all", options(kFrames));
  FrameLoopOptions loop = options(kFrames);
  ASSERT_EQ(parse_frame_set("2,5..:5", loop.output_frames), "");
  ASSERT_EQ(parse_frame_set("0,5..7", loop.dump_frames), "");
  render("some", loop);
  auto expected = test::run_files(folder_ / "all");
  const auto some = test::run_files(folder_ / "some");
  std::erase_if(expected, [](const auto& file) {
    const std::string& name = file.first;
    const bool dump = name.starts_with("dumps/");
    const std::vector<const char*> kept = dump ? std::vector<const char*>{"/0000/", "/0005/", "/0006/", "/0007/"}
                                               : std::vector<const char*>{".0002.", ".0005.", ".0010."};
    return std::none_of(kept.begin(), kept.end(),
                        [&](const char* number) { return name.find(number) != std::string::npos; });
  });
  EXPECT_EQ(expected.size(), 3 * 2 + 4 * (3 + 1U));
  for (const auto& [name, bytes] : expected) EXPECT_TRUE(some.contains(name) && some.at(name) == bytes) << name;
  EXPECT_EQ(some.size(), expected.size() + 1) << "and dumps/index.json";
  EXPECT_EQ(ordered_json::parse(some.at("dumps/index.json"))["frames"].size(), 4U);
}

TEST_F(FrameLoopTest, AWriterThatFailsEndsTheRunWithItsError) {
  FrameLoopOptions loop = options(1000);
  loop.describe = [&](const FrameResult& frame) {
    if (frame.frame == 2) std::ofstream(folder_ / "run/dumps/0003") << "a file in the way";
    return ordered_json{{"frame", frame.frame}};
  };
  Executor frames = executor();
  RunFolder folder(folder_ / "run");
  RunProgress progress;
  try {
    render_frames(frames, folder, progress, loop);
    FAIL() << "the folder of frame 3 cannot be made";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_NE(std::string(error.what()).find("dumps/0003"), std::string::npos) << error.what();
  }
  EXPECT_LE(progress.frames(), 6U);
  const auto files = test::run_files(folder_ / "run");
  EXPECT_TRUE(files.contains("dumps/0002/frame.json")) << "the frames before are whole";
  EXPECT_EQ(ordered_json::parse(files.at("dumps/0002/frame.json"))["frame"], 2);
  EXPECT_FALSE(files.contains("count.0004.exr"));
  for (const auto& [name, bytes] : files) EXPECT_NE(fs::path(name).filename().string().front(), '.') << name;
}

TEST_F(FrameLoopTest, WhatWasRenderedBeforeAFailureIsWritten) {
  in_stage_ = [](uint32_t frame) {
    if (frame == 3) throw Error(ExitCode::run_failed, "no luck");
  };
  FrameLoopOptions loop = options(5);
  loop.checkpoint_every = 1;
  loop.identity = {{"what", "test"}};
  loop.describe = [&](const FrameResult&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    return ordered_json{};
  };
  Executor frames = executor();
  RunFolder folder(folder_ / "run");
  RunProgress progress;
  EXPECT_THROW(render_frames(frames, folder, progress, loop), Error);
  const auto files = test::run_files(folder_ / "run");
  EXPECT_TRUE(files.contains("count.0002.exr"));
  EXPECT_TRUE(files.contains("dumps/0002/frame.json"));
  const std::optional<Checkpoint> checkpoint = read_checkpoint(folder_ / "run");
  ASSERT_TRUE(checkpoint);
  EXPECT_EQ(checkpoint->progress.frames(), 3U);
  EXPECT_EQ(checkpoint->folder["dumped_frames"].dump(), "[[0,2]]");
}

TEST_F(FrameLoopTest, ACheckpointNeverCountsAFrameWhoseFilesAreMissing) {
  FrameLoopOptions loop = options(6);
  loop.checkpoint_every = 1;
  loop.identity = {{"what", "test"}};
  int looked = 0;
  // The state on the disk is what a killed process would leave.
  loop.describe = [&](const FrameResult&) {
    const std::optional<Checkpoint> checkpoint = read_checkpoint(folder_ / "run");
    if (!checkpoint) return ordered_json{};
    ++looked;
    for (const fs::path& file : WrittenFiles(checkpoint->folder["files"]).all())
      EXPECT_TRUE(fs::exists(folder_ / "run" / file)) << file;
    EXPECT_EQ(checkpoint->folder["dumped_frames"].dump(),
              "[[0," + std::to_string(checkpoint->progress.frames() - 1) + "]]");
    return ordered_json{};
  };
  render("run", loop);
  EXPECT_EQ(looked, 5);
}

TEST_F(FrameLoopTest, CheckpointsByTimeComeAtTheEndsOfFrames) {
  FrameLoopOptions loop = options(6);
  loop.checkpoint_time = std::chrono::hours(1);
  loop.identity = {{"what", "test"}};
  uint32_t seen = 0;
  loop.describe = [&](const FrameResult&) {
    if (const std::optional<Checkpoint> checkpoint = read_checkpoint(folder_ / "run"))
      seen = checkpoint->progress.frames();
    return ordered_json{};
  };
  render("run", loop);
  EXPECT_EQ(seen, 0U) << "the time is not over";
  ASSERT_TRUE(read_checkpoint(folder_ / "run"));
  EXPECT_EQ(read_checkpoint(folder_ / "run")->progress.frames(), 6U) << "the last frame has one";
  fs::remove_all(folder_ / "run");
  loop.checkpoint_time = std::chrono::nanoseconds(1);
  render("run", loop);
  EXPECT_EQ(seen, 5U) << "the time is over after each frame";
}

TEST_F(FrameLoopTest, OneFrameAtATimeIsUnderWay) {
  Executor frames = executor();
  EXPECT_THROW(static_cast<void>(frames.finish_frame()), std::logic_error);
  frames.start_frame(0);
  EXPECT_THROW(frames.start_frame(1), std::logic_error);
  const FinishedFrame finished = frames.finish_frame();
  frames.start_frame(1, {.outputs = true, .captures = false});
  const FrameResult first = frames.fetch(finished);
  EXPECT_EQ(first.outputs.at(0).image.at(8, 3, 0, 0), 1);
  EXPECT_EQ(first.captures.size(), 3U);
  const FrameResult second = frames.fetch(frames.finish_frame());
  EXPECT_EQ(second.outputs.at(0).image.at(8, 3, 0, 0), 2);
  EXPECT_TRUE(second.captures.empty());
  frames.start_frame(2);  // and is left under way: the executor waits for it
}

}  // namespace
}  // namespace lightloom::run
