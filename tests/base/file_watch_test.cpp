#include "framework/base/file_watch.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "framework/base/atomic_file.hpp"
#include "framework/base/hash.hpp"

namespace lightloom {
namespace {

namespace fs = std::filesystem;

class FileWatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lightloom-file-watch-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    write("a", "one");
    write("b", "two");
    watch_.watch({{file("a"), hash_text("one")}, {file("b"), hash_text("two")}, {file("missing"), std::nullopt}});
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const char* name) const { return folder_ / name; }
  void write(const char* name, const char* text) const { std::ofstream(file(name), std::ios::trunc) << text; }

  /// What two looks find; the second one sees what has settled.
  std::vector<fs::path> settled() {
    static_cast<void>(watch_.look());
    return watch_.look();
  }

  fs::path folder_;
  FileWatch watch_;
};

TEST_F(FileWatchTest, FilesThatStayAreNoChange) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(watch_.look().empty());
}

TEST_F(FileWatchTest, AChangeCountsOnceTheFileHasSettled) {
  EXPECT_TRUE(watch_.look().empty());
  write("a", "more");
  EXPECT_TRUE(watch_.look().empty()) << "it may still be written";
  write("a", "more of it");
  EXPECT_TRUE(watch_.look().empty()) << "it was";
  EXPECT_EQ(watch_.look(), (std::vector<fs::path>{file("a")}));
  EXPECT_EQ(watch_.look(), (std::vector<fs::path>{file("a")})) << "until it is known what was read";
  watch_.watch({{file("a"), hash_text("more of it")}});
  EXPECT_TRUE(settled().empty());
}

TEST_F(FileWatchTest, NoChangeIsReportedWhileAnotherFileIsWritten) {
  EXPECT_TRUE(watch_.look().empty());
  write("a", "new");
  EXPECT_TRUE(watch_.look().empty());
  write("b", "new as well");
  EXPECT_TRUE(watch_.look().empty());
  EXPECT_EQ(watch_.look(), (std::vector<fs::path>{file("a"), file("b")}));
}

TEST_F(FileWatchTest, ReplacedRemovedAndNewFilesAreChanges) {
  EXPECT_TRUE(watch_.look().empty());
  write_file_atomically(file("a"), std::string_view("ONE"));
  EXPECT_EQ(settled(), (std::vector<fs::path>{file("a")})) << "same size, another file";
  write_file_atomically(file("a"), std::string_view("one"));
  fs::remove(file("b"));
  EXPECT_EQ(settled(), (std::vector<fs::path>{file("b")}));
  write("b", "two");
  write("missing", "here");
  EXPECT_EQ(settled(), (std::vector<fs::path>{file("missing")}));
}

TEST_F(FileWatchTest, TheSameContentsWrittenAgainAreNoChange) {
  EXPECT_TRUE(watch_.look().empty());
  write_file_atomically(file("a"), std::string_view("one"));
  EXPECT_TRUE(settled().empty());
}

TEST_F(FileWatchTest, AChangeBetweenReadingAndTheFirstLookIsFound) {
  write("a", "new");
  EXPECT_EQ(settled(), (std::vector<fs::path>{file("a")}));
}

}  // namespace
}  // namespace lightloom
