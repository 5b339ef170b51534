#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "framework/base/file.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {

/// The program under the layer of faults, with the validation layer above it, which writes to standard output.
class FaultTest : public ProgramTest {
 protected:
  FaultTest() {
    setenv("VK_ADD_LAYER_PATH", LIGHTLOOM_FAULT_LAYER, 1);
    setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation:VK_LAYER_LIGHTLOOM_faults", 1);
    std::ofstream(folder_ / "tiny.json") << R"({"lightloom": 1, "name": "tiny", "view": {"width": 24, "height": 16},
      "params": {"resolution": 16},
      "passes": {
        "gather": {"type": "gather"},
        "voxels": {"type": "voxelize", "params": {"resolution": "$resolution"}},
        "distance": {"type": "distance_transform", "in": {"voxels": "voxels.voxels"}},
        "trace": {"type": "voxel_path_trace",
                  "in": {"surface": "gather.surface", "voxels": "voxels.voxels", "distance": "distance.distance"}},
        "mean": {"type": "accumulate", "in": {"radiance": "trace.radiance", "past": "mean.accumulation@1"}},
        "tonemap": {"type": "tonemap", "in": {"radiance": "mean.radiance"}}},
      "outputs": {"radiance": "mean.radiance", "image": "tonemap.image"}})";
  }
  ~FaultTest() override {
    unsetenv("LIGHTLOOM_FAULTS");
    unsetenv("VK_INSTANCE_LAYERS");
    unsetenv("VK_ADD_LAYER_PATH");
  }

  /// Renders `frames` frames of the tiny graph; returns the exit code. `faults` as in fault_plan.hpp.
  int render(const std::string& faults, const std::string& out, uint32_t frames = 2,
             const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = arguments(out, frames);
    all.insert(all.end(), more.begin(), more.end());
    return run_with(faults, all);
  }
  [[nodiscard]] std::vector<std::string> arguments(const std::string& out, uint32_t frames) const {
    return {"render",   (folder_ / "tiny.json").string(),
            "--scene",  (source_dir() / "samples/scenes/atrium.scene.json").string(),
            "--frames", "0.." + std::to_string(frames - 1),
            "--out",    (folder_ / out).string()};
  }

  int run_with(const std::string& faults, const std::vector<std::string>& arguments) {
    const std::filesystem::path log = folder_ / ("log" + std::to_string(++runs_));
    setenv("LIGHTLOOM_FAULTS", ("log=" + log.string() + (faults.empty() ? "" : ";" + faults)).c_str(), 1);
    ::testing::internal::CaptureStdout();
    const int code = run(arguments);
    validation_ = ::testing::internal::GetCapturedStdout();
    read_log(log);
    return code;
  }

  /// One clear sentence, and no complaint of the validation layer.
  void expect_clear_failure(int code, int expected) const {
    EXPECT_EQ(code, expected) << err_;
    EXPECT_TRUE(err_.starts_with("error: ")) << err_;
    EXPECT_EQ(err_.find("error: ", 1), std::string::npos) << err_;
    EXPECT_EQ(out_, "");
    expect_clean();
  }
  void expect_clean() const {
    EXPECT_EQ(validation_.find("Validation"), std::string::npos) << validation_;
    EXPECT_EQ(bytes_left_, 0u) << "device memory was not freed";
  }

  /// Whatever stands in the folder is what the good run has there.
  void expect_nothing_half_written(const std::string& out, const std::string& good) const {
    if (!std::filesystem::exists(folder_ / out)) return;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / out)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().filename().string();
      const std::string extension = entry.path().extension().string();
      EXPECT_FALSE(name.starts_with(".")) << name << " is a file under its working name";
      EXPECT_NE(name, "run.json") << "a run that failed says that it is finished";
      if (extension != ".exr" && extension != ".png") continue;
      EXPECT_TRUE(read_text_file(entry.path()) == read_text_file(folder_ / good / name)) << name;
    }
  }

  std::vector<std::string> names_in(const std::string& out) const {
    std::vector<std::string> names;
    if (!std::filesystem::exists(folder_ / out)) return names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / out))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::map<std::string, uint64_t> calls_;  ///< of the last run, by function
  uint32_t struck_ = 0;                    ///< entries of its faults that took place
  uint64_t bytes_left_ = 0;                ///< of device memory, when its instance went
  std::string validation_;

 private:
  void read_log(const std::filesystem::path& log) {
    calls_.clear();
    struck_ = 0;
    std::ifstream file(log);
    std::string word;
    std::string value;
    while (file >> word && std::getline(file, value)) {
      if (word == "struck")
        ++struck_;
      else if (word == "bytes_left")
        bytes_left_ = std::stoull(value);
      else
        calls_[word] = std::stoull(value);
    }
  }

  uint32_t runs_ = 0;
};

}  // namespace lightloom::cli
