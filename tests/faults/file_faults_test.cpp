// Files that cannot be written, at each call in turn, by a library that fails chosen calls of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "framework/base/file.hpp"
#include "framework/image/read_image.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;
using Files = std::map<std::string, std::string>;

/// What is done to the program; the variables of tests/faults/preload/file_faults.cpp.
struct Fault {
  std::string call = "write";
  long nth = 0;
  int cause = ENOSPC;
  bool stays = true;
  fs::path remove = {};
  long clock_jump = 0;
};

class Environment {
 public:
  explicit Environment(const std::map<std::string, std::string>& variables) : variables_(variables) {
    for (const auto& [name, value] : variables_) setenv(name.c_str(), value.c_str(), 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() {
    for (const auto& [name, value] : variables_) unsetenv(name.c_str());
  }

 private:
  std::map<std::string, std::string> variables_;
};

class FileFaults : public ::testing::Test {
 protected:
  FileFaults() {
    std::string name = (fs::temp_directory_path() / "lightloom_file_faults_XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::ofstream(folder_ / "tiny.json") << R"({"lightloom": 1, "name": "tiny", "view": {"width": 16, "height": 12},
      "passes": {"gather": {"type": "gather"},
                 "voxels": {"type": "voxelize", "params": {"resolution": 8}},
                 "distance": {"type": "distance_transform", "in": {"voxels": "voxels.voxels"}},
                 "trace": {"type": "voxel_path_trace", "in": {"surface": "gather.surface", "voxels": "voxels.voxels",
                                                              "distance": "distance.distance"}},
                 "mean": {"type": "accumulate", "in": {"radiance": "trace.radiance", "past": "mean.accumulation@1"}},
                 "tonemap": {"type": "tonemap", "in": {"radiance": "mean.radiance"}}},
      "outputs": {"radiance": "mean.radiance", "image": "tonemap.image"}})";
  }
  ~FileFaults() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// Two frames with dumps and a checkpoint into `out`; the exit code.
  int render(const Fault& fault, const std::string& out, const Words& more = {}) {
    Words words = {"render",       (folder_ / "tiny.json").string(),
                   "--scene",      (source_dir() / "samples/scenes/atrium.scene.json").string(),
                   "--frames",     "0..1",
                   "--dump",       "trace.radiance",
                   "--checkpoint", "1",
                   "--out",        (folder_ / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    const fs::path log = folder_ / "calls";
    const Environment environment({{"LD_PRELOAD", LIGHTLOOM_FILE_FAULTS},
                                   {"LIGHTLOOM_FILE_PREFIX", (folder_ / out).string()},
                                   {"LIGHTLOOM_FILE_CALL", fault.call},
                                   {"LIGHTLOOM_FILE_NTH", std::to_string(fault.nth)},
                                   {"LIGHTLOOM_FILE_ERRNO", std::to_string(fault.cause)},
                                   {"LIGHTLOOM_FILE_STAYS", fault.stays ? "1" : "0"},
                                   {"LIGHTLOOM_FILE_REMOVE", fault.remove.string()},
                                   {"LIGHTLOOM_FILE_LOG", log.string()},
                                   {"LIGHTLOOM_CLOCK", std::to_string(fault.clock_jump)}});
    test::ChildProgram child(LIGHTLOOM_PROGRAM, words, folder_ / "messages");
    const int status = child.wait();
    std::ifstream(log) >> calls_ >> struck_;
    messages_ = read_text_file(folder_ / "messages");
    return status;
  }

  [[nodiscard]] Files files_of(const std::string& out) const {
    Files files;
    if (!fs::exists(folder_ / out)) return files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / out))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), folder_ / out).generic_string()] = read_text_file(entry.path());
    return files;
  }

  void expect_one_error(int status, const std::string& reason) const {
    EXPECT_EQ(status, 1) << messages_;
    EXPECT_TRUE(messages_.starts_with("error: ")) << messages_;
    EXPECT_EQ(messages_.find("error: ", 1), std::string::npos) << messages_;
    EXPECT_THAT(messages_, HasSubstr(reason));
    EXPECT_THAT(messages_, HasSubstr(folder_.string())) << "the file is named";
  }

  /// Of a run that failed: each frame is there with all its files, whole as in `good`, or not at all.
  void expect_whole_frames(const Files& files, const Files& good) const {
    std::map<std::string, std::set<std::string>> frames;
    std::map<std::string, size_t> wanted;
    for (const auto& [name, bytes] : good)
      for (const char* frame : {"0000", "0001"})
        if (name.find(frame) != std::string::npos) ++wanted[frame];
    for (const auto& [name, bytes] : files) {
      EXPECT_NE(fs::path(name).filename().string().front(), '.') << name;
      ASSERT_TRUE(good.contains(name)) << name;
      EXPECT_NE(name, "run.json") << "a run that failed says that it is done";
      for (const char* frame : {"0000", "0001"})
        if (name.find(frame) != std::string::npos) frames[frame].insert(name);
      EXPECT_TRUE(name.starts_with("checkpoint/") || bytes == good.at(name)) << name;
    }
    for (const auto& [frame, names] : frames) EXPECT_EQ(names.size(), wanted[frame]) << "a part of frame " << frame;
  }

  /// Strikes every `step`-th call of a kind in a new folder, in one that has an earlier run, and with --resume after
  /// it.
  void drive(const std::string& call, int cause, long step, long begin = 1) {
    ASSERT_EQ(render({.call = call}, "good"), 0) << messages_;
    const long calls = calls_;
    ASSERT_GT(calls, 0) << call << " is never called: the test shows nothing";
    const Files good = files_of("good");
    for (long nth = begin; nth <= calls; nth += step) {
      SCOPED_TRACE(call + " " + std::to_string(nth) + " of " + std::to_string(calls));
      const int status = render({.call = call, .nth = nth, .cause = cause}, "new");
      // The text of the lock is for messages alone, and what is there already need not be made.
      if (status == 0) {
        fs::remove_all(folder_ / "new");
        ++forgiven_;
        continue;
      }
      EXPECT_GE(struck_, 1);
      expect_one_error(status, std::generic_category().message(cause));
      expect_whole_frames(files_of("new"), good);
      // Then the disk has room again.
      EXPECT_EQ(render({}, "new", {"--resume"}), 0) << messages_;
      Files resumed = files_of("new"), wanted = good;
      for (Files* files : {&resumed, &wanted}) {
        files->erase("run.json");
        files->erase("checkpoint/state.bin");
      }
      EXPECT_TRUE(resumed == wanted);
      fs::remove_all(folder_ / "new");
    }
  }

  fs::path folder_;
  std::string messages_;
  long calls_ = 0;   ///< of the last run
  long struck_ = 0;  ///< of them, those that failed
  long forgiven_ = 0;
};

TEST_F(FileFaults, ADiskThatFillsUpNamesTheFileAndTheRoom) {
  drive("write", ENOSPC, 4, 2);
  EXPECT_LE(forgiven_, 1);
  fs::remove_all(folder_ / "new");
  ASSERT_EQ(render({.call = "write", .nth = 3, .cause = ENOSPC}, "new"), 1);
  EXPECT_THAT(messages_, ::testing::ContainsRegex("hint: it needs [0-9]+ bytes, and [0-9]+ are free there; free some"));
}

TEST_F(FileFaults, AnEarlierRunStaysWhereNoFrameIsDone) {
  ASSERT_EQ(render({}, "run", {"--seed", "1"}), 0) << messages_;
  const Files earlier = files_of("run");
  int kept = 0;
  for (const char* call : {"write", "open", "rename", "close", "link"}) {
    for (long nth = 1; nth <= 6; nth += 2) {
      SCOPED_TRACE(call + std::string(" ") + std::to_string(nth));
      // One failure, after which the disk works: what is put back is put back by rename.
      const int status = render({.call = call, .nth = nth, .cause = EDQUOT, .stays = false}, "run", {"--seed", "1"});
      if (status == 0) continue;  // forgiven: the lock's text, a link where a new name does as well
      expect_one_error(status, std::generic_category().message(EDQUOT));
      const Files now = files_of("run");
      EXPECT_TRUE(now == earlier);
      for (const auto& [name, bytes] : now) EXPECT_TRUE(earlier.contains(name)) << name;
      ++kept;
    }
  }
  EXPECT_GE(kept, 8);
}

TEST_F(FileFaults, AFolderThatIsRemovedMeanwhileIsTold) {
  ASSERT_EQ(render({.call = "rename"}, "good"), 0) << messages_;
  const long calls = calls_;
  for (const char* part : {"run/dumps", "run"}) {
    int told = 0;
    for (long nth = calls / 2; nth <= calls; nth += 2) {
      SCOPED_TRACE(part + std::string(" before rename ") + std::to_string(nth) + " of " + std::to_string(calls));
      const int status = render({.call = "rename", .nth = nth, .stays = false, .remove = folder_ / part}, "run");
      const Files left = files_of("run");
      if (status != 0) {
        ++told;
        EXPECT_EQ(status, 1) << messages_;
        EXPECT_THAT(messages_, AnyOf(HasSubstr("removed or replaced"), HasSubstr("No such file")));
        EXPECT_FALSE(left.contains("run.json"));
      }
      for (const auto& [name, bytes] : left) EXPECT_NE(fs::path(name).filename().string().front(), '.') << name;
      fs::remove_all(folder_ / "run");
    }
    EXPECT_GE(told, 2) << part;
  }
}

TEST_F(FileFaults, APlaceThatNobodyMayWriteTo) {
  // Refused by the kernel also for who may do everything.
  for (const char* place : {"/proc/lightloom", "/sys/lightloom"}) {
    EXPECT_EQ(render({}, place), 1) << place;
    EXPECT_THAT(messages_, HasSubstr(place));
    EXPECT_TRUE(messages_.starts_with("error: ")) << messages_;
  }
  std::ofstream(folder_ / "file") << "x";
  EXPECT_EQ(render({}, "file"), 1);
  EXPECT_EQ(render({}, "file/below"), 1);
  EXPECT_THAT(messages_, HasSubstr((folder_ / "file").string()));
  EXPECT_EQ(read_text_file(folder_ / "file"), "x");
  fs::create_directories(folder_ / "taken/image.0001.png/inside");
  EXPECT_EQ(render({}, "taken"), 1) << "a folder in the place of a file";
  EXPECT_THAT(messages_, HasSubstr("image.0001.png"));
  EXPECT_TRUE(fs::exists(folder_ / "taken/image.0001.png/inside"));
  EXPECT_TRUE(fs::exists(folder_ / "taken/image.0000.png"));
  EXPECT_FALSE(fs::exists(folder_ / "taken/radiance.0001.exr")) << "a part of a frame";
  for (const int cause : {EROFS, EACCES}) {
    EXPECT_EQ(render({.call = "open", .nth = 1, .cause = cause}, "read_only"), 1);
    EXPECT_THAT(messages_, HasSubstr("choose a folder that you may write to"));
    EXPECT_FALSE(fs::exists(folder_ / "read_only")) << "what the run has made goes again";
  }
}

TEST_F(FileFaults, TheClockOfTheDayMayJump) {
  ASSERT_EQ(render({}, "good"), 0) << messages_;
  Files good = files_of("good");
  for (const long jump : {-3600L, 86400L}) {
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(render({.clock_jump = jump}, "run"), 0) << messages_;
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(messages_, "");
    const nlohmann::json record = nlohmann::json::parse(read_text_file(folder_ / "run/run.json"));
    const double frame = record["frame_wall_ms"]["median"];
    EXPECT_GT(frame, 0);
    EXPECT_LT(frame, elapsed.count());
    Files files = files_of("run");
    for (Files* each : {&files, &good}) {
      each->erase("run.json");
      each->erase("checkpoint/state.bin");
    }
    EXPECT_TRUE(files == good);
    fs::remove_all(folder_ / "run");
  }
}

class EveryFileCall : public FileFaults, public ::testing::WithParamInterface<const char*> {};

TEST_P(EveryFileCall, MayFail) {
  const std::string call = GetParam();
  drive(call, call == "open" || call == "mkdir" ? EACCES : call == "close" || call == "fsync" ? EIO : ENOSPC, 1);
  EXPECT_LE(forgiven_, 1) << "a failure was not told";
}

INSTANTIATE_TEST_SUITE_P(Slow, EveryFileCall,
                         ::testing::Values("open", "write", "close", "rename", "mkdir", "fsync", "syncfs"));

}  // namespace
}  // namespace lightloom::cli
