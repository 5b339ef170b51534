#include "framework/run/run_folder.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "framework/base/error.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

class RunFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("lightloom-run-folder-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

image::HostImage small_image(Format format, Dimension dimension = Dimension::d2) {
  image::HostImage image;
  image.desc = {format, dimension, {3, 2, dimension == Dimension::d3 ? 4u : 1u}};
  image.texels.resize(byte_size(image.desc));
  return image;
}

Graph graph_with(const std::vector<Value>& values) {
  Graph graph;
  graph.values = values;
  return graph;
}

FrameResult outputs_only(uint32_t frame) {
  FrameResult result;
  result.frame = frame;
  result.outputs = {{"radiance", small_image(Format::rgba32_sfloat)}, {"image", small_image(Format::rgba8_unorm)}};
  return result;
}

TEST_F(RunFolderTest, WritesOutputsDumpsAndIndex) {
  FrameResult result = outputs_only(7);
  Value plane{.pass = "gather",
              .port = "surface",
              .part = "id",
              .desc = small_image(Format::rg32_uint).desc,
              .constant = {},
              .history = 0,
              .scratch = false};
  Value volume{.pass = "merge",
               .port = "voxels",
               .part = "albedo",
               .desc = small_image(Format::rgba8_unorm, Dimension::d3).desc,
               .constant = {},
               .history = 0,
               .scratch = false};
  result.captures = {{"gather.surface.id", small_image(Format::rg32_uint)},
                     {"merge.voxels.albedo", small_image(Format::rgba8_unorm, Dimension::d3)}};
  RunFolder folder(folder_);
  folder.write_frame(graph_with({plane, volume}), result, {{"time", 0.25}});
  folder.finish({{"lightloom", "test"}});
  for (const char* file : {"radiance.0007.exr", "image.0007.png", "dumps/0007/gather.surface.id.exr",
                           "dumps/0007/merge.voxels.albedo.npy", "dumps/index.json", "run.json"})
    EXPECT_TRUE(fs::is_regular_file(folder_ / file)) << file;
  std::ifstream stream(folder_ / "dumps/index.json");
  const nlohmann::json index = nlohmann::json::parse(stream);
  ASSERT_EQ(index["values"].size(), 2u);
  EXPECT_EQ(index["values"]["merge.voxels.albedo"]["depth"], 4);
  EXPECT_EQ(index["values"]["gather.surface.id"]["channels"], nlohmann::json({"object", "material"}));
  ASSERT_EQ(index["frames"].size(), 1u);
  EXPECT_EQ(index["frames"][0]["frame"], 7);
  EXPECT_EQ(index["frames"][0]["files"]["gather.surface.id"], "dumps/0007/gather.surface.id.exr");
  std::ifstream conditions(folder_ / index["frames"][0]["conditions"].get<std::string>());
  EXPECT_EQ(nlohmann::json::parse(conditions)["time"], 0.25);
}

TEST_F(RunFolderTest, RemovesTheFilesOfTheRunBeforeAndNoOthers) {
  {
    RunFolder folder(folder_);
    folder.write_frame({}, outputs_only(0), {});
    folder.write_frame({}, outputs_only(1), {});
    folder.finish({{"lightloom", "test"}});
  }
  std::ofstream(folder_ / "notes.txt") << "mine";
  { RunFolder failed(folder_); }
  EXPECT_TRUE(fs::exists(folder_ / "run.json")) << "a run that writes nothing leaves the one before";
  EXPECT_TRUE(fs::exists(folder_ / "image.0001.png"));
  RunFolder folder(folder_);
  folder.write_frame({}, outputs_only(0), {});
  EXPECT_FALSE(fs::exists(folder_ / "run.json")) << "a folder whose run is under way must not look finished";
  EXPECT_FALSE(fs::exists(folder_ / "image.0001.png")) << "of the run before, when a new frame is there";
  folder.finish({{"lightloom", "test"}});
  EXPECT_TRUE(fs::exists(folder_ / "image.0000.png"));
  EXPECT_FALSE(fs::exists(folder_ / "image.0001.png")) << "a stale frame";
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
}

TEST_F(RunFolderTest, ARecordThatPointsOutsideRemovesNothingThere) {
  fs::create_directories(folder_ / "run");
  std::ofstream(folder_ / "outside.txt") << "mine";
  std::ofstream(folder_ / "run/run.json") << R"({"lightloom": "x", "files": ["../outside.txt", 3]})";
  RunFolder folder(folder_ / "run");
  folder.finish({{"lightloom", "test"}});
  EXPECT_TRUE(fs::exists(folder_ / "outside.txt"));
}

TEST_F(RunFolderTest, AFileInTheWayIsAClearError) {
  std::ofstream(folder_) << "a file";
  try {
    RunFolder folder(folder_);
    FAIL() << "a run folder was made over a file";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lightloom::run
