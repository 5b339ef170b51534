#include "framework/base/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

using ::testing::HasSubstr;

class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "lightloom_atomic_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] size_t file_count() const {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  static std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  std::filesystem::path folder_;
};

/// A limit on file sizes stands in for a full disk: the kernel writes up to the limit, then refuses.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

TEST_F(AtomicFile, writes_all_bytes_and_nothing_else) {
  const std::string text("a\0b\n", 4);
  write_file_atomically(folder_ / "a.bin", text);
  EXPECT_EQ(content(folder_ / "a.bin"), text);
  write_file_atomically(folder_ / "empty", "");
  EXPECT_EQ(content(folder_ / "empty"), "");
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(AtomicFile, replaces_an_older_file) {
  write_file_atomically(folder_ / "a", "a long first version");
  write_file_atomically(folder_ / "a", "second");
  EXPECT_EQ(content(folder_ / "a"), "second");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, a_failed_write_leaves_the_older_file_and_no_other) {
  write_file_atomically(folder_ / "a", "first");
  {
    const FileSizeLimit limit(1000);
    try {
      write_file_atomically(folder_ / "a", std::string(100000, 'x'));
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::run_failed);
      EXPECT_THAT(error.what(), HasSubstr((folder_ / "a").string()));
    }
  }
  EXPECT_EQ(content(folder_ / "a"), "first");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, a_missing_folder_and_a_file_as_folder_are_errors_with_a_hint) {
  write_file_atomically(folder_ / "file", "x");
  for (const char* target : {"missing/a", "file/a"}) {
    try {
      write_file_atomically(folder_ / target, "x");
      FAIL() << target;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(target));
      EXPECT_EQ(error.hint(), "the folder must exist");
    }
  }
}

TEST_F(AtomicFile, a_folder_in_the_place_of_the_file_stays) {
  std::filesystem::create_directory(folder_ / "a");
  write_file_atomically(folder_ / "a/inside", "x");
  EXPECT_THROW(write_file_atomically(folder_ / "a", "x"), Error);
  EXPECT_EQ(content(folder_ / "a/inside"), "x");
  EXPECT_EQ(file_count(), 1u);
}

}  // namespace
}  // namespace lightloom
