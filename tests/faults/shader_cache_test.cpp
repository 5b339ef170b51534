// What may stand in the place of an entry of the shader cache: it is compiled anew, with the same words.
#include <sys/stat.h>

#include <array>
#include <functional>
#include <thread>

#include "framework/gpu/shader_compiler.hpp"
#include "tests/faults/fault_fixture.hpp"

namespace lightloom::gpu {
namespace {

namespace fs = std::filesystem;

class ShaderCacheFaults : public ::testing::Test {
 protected:
  ShaderCacheFaults() {
    std::string name = (fs::temp_directory_path() / "lightloom_cache_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~ShaderCacheFaults() override { fs::remove_all(folder_); }

  /// As a new process would.
  std::vector<uint32_t> compile(CompileStatistics* statistics = nullptr) const {
    ShaderCompiler compiler({.include_directories = {}, .cache_directory = folder_});
    const std::array stages{ShaderSource{
        "a.comp", "layout(local_size_x = 1) in;\nlayout(std430) buffer R { float r; };\nvoid main() { r = 2.0; }\n",
        Stage::compute}};
    std::vector<uint32_t> words = compiler.compile(stages)[0].words;
    if (statistics != nullptr) *statistics = compiler.statistics();
    return words;
  }
  [[nodiscard]] fs::path entry() const { return fs::directory_iterator(folder_)->path(); }

  fs::path folder_;
};

TEST_F(ShaderCacheFaults, EachByteFlippedOrTheEndCutOffIsNoticed) {
  const std::vector<uint32_t> good = compile();
  const fs::path file = entry();
  const std::string bytes = read_text_file(file);
  const auto expect_rebuilt = [&](const std::string& damaged, const std::string& what) {
    std::ofstream(file, std::ios::binary) << damaged;
    CompileStatistics statistics;
    ASSERT_EQ(compile(&statistics), good) << what;
    ASSERT_EQ(statistics.rejected_cache_entries, 1u) << what;
    ASSERT_EQ(statistics.compiled, 1u) << what;
  };
  for (size_t byte = 0; byte < bytes.size(); ++byte) {
    std::string flipped = bytes;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << (byte % 8)));
    expect_rebuilt(flipped, "byte " + std::to_string(byte));
  }
  for (size_t length = 0; length < bytes.size(); length += 13)
    expect_rebuilt(bytes.substr(0, length), "length " + std::to_string(length));
  EXPECT_EQ(read_text_file(file), bytes);
}

TEST_F(ShaderCacheFaults, APipeInItsPlaceDoesNotLetTheRunWait) {
  const std::vector<uint32_t> good = compile();
  const fs::path file = entry();
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  CompileStatistics statistics;
  EXPECT_EQ(compile(&statistics), good);
  EXPECT_EQ(statistics.rejected_cache_entries, 1u);
  EXPECT_TRUE(fs::is_regular_file(file)) << "the pipe was not replaced";
}

TEST_F(ShaderCacheFaults, AFolderInItsPlaceOnlyCostsTime) {
  const std::vector<uint32_t> good = compile();
  const fs::path file = entry();
  fs::remove(file);
  fs::create_directory(file);
  CompileStatistics statistics;
  EXPECT_EQ(compile(&statistics), good);
  EXPECT_FALSE(statistics.cache_write_failure.empty());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "a file was left behind";
}

TEST_F(ShaderCacheFaults, AnEntryOfAbsurdSizeIsNotRead) {
  const std::vector<uint32_t> good = compile();
  fs::resize_file(entry(), uintmax_t{1} << 40);
  CompileStatistics statistics;
  EXPECT_EQ(compile(&statistics), good);
  EXPECT_EQ(statistics.rejected_cache_entries, 1u);
  EXPECT_LT(fs::file_size(entry()), 10'000u) << "it was not replaced";
}

TEST_F(ShaderCacheFaults, AnEntryThatMayNotBeReadIsReplaced) {
  const std::vector<uint32_t> good = compile();
  fs::permissions(entry(), fs::perms::none);
  CompileStatistics statistics;
  EXPECT_EQ(compile(&statistics), good);
  EXPECT_EQ(statistics.cache_write_failure, "");
  // Who may read everything has used it.
  if (::geteuid() == 0) return;
  EXPECT_EQ(statistics.rejected_cache_entries, 1u);
  EXPECT_EQ(compile(&statistics), good);
  EXPECT_EQ(statistics.from_cache, 1u) << "it was not replaced";
}

TEST_F(ShaderCacheFaults, ALinkIntoNowhereIsReplaced) {
  const std::vector<uint32_t> good = compile();
  const fs::path file = entry();
  fs::remove(file);
  fs::create_symlink(folder_ / "nowhere" / "at" / "all", file);
  EXPECT_EQ(compile(), good);
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(file)));
}

TEST_F(ShaderCacheFaults, AFolderThatCannotBeMadeOnlyCostsTime) {
  const std::vector<uint32_t> good = compile();
  const fs::path parent = folder_;
  std::ofstream(parent / "file") << "in the way";
  fs::create_directory_symlink(parent / "circle", parent / "circle");
  for (const char* place : {"file", "file/below", "circle", "circle/below"}) {
    folder_ = parent / place;
    CompileStatistics statistics;
    EXPECT_EQ(compile(&statistics), good) << place;
    EXPECT_NE(statistics.cache_write_failure, "") << place;
  }
  folder_ = parent;
  EXPECT_EQ(read_text_file(parent / "file"), "in the way");
}

TEST_F(ShaderCacheFaults, TwoThatWriteOneEntryLeaveAWholeOne) {
  const std::vector<uint32_t> good = compile();
  const fs::path file = entry();
  const auto work = [&](std::string& problems) {
    for (int i = 0; i < 50; ++i) {
      std::error_code ignored;
      fs::remove(file, ignored);
      CompileStatistics statistics;
      if (compile(&statistics) != good) problems += "other words; ";
      problems += statistics.cache_write_failure;
    }
  };
  std::array<std::string, 2> problems;
  {
    const std::jthread other(work, std::ref(problems[1]));
    work(problems[0]);
  }
  EXPECT_EQ(problems[0] + problems[1], "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "a file was left behind";
  CompileStatistics statistics;
  EXPECT_EQ(compile(&statistics), good);
  EXPECT_EQ(statistics.from_cache, 1u);
}

TEST_F(ShaderCacheFaults, TheFolderMayGoAtAnyTime) {
  const std::vector<uint32_t> good = compile();
  fs::remove_all(folder_);
  EXPECT_EQ(compile(), good);
}

}  // namespace
}  // namespace lightloom::gpu
