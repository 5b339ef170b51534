#include <array>

#include "framework/gpu/shader_compiler.hpp"
#include "tests/gpu/gpu_support.hpp"

namespace lightloom::gpu {
namespace {

using test::compute_source;
using test::TemporaryFolder;

class SpirvCache : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("lib/value.glsl", "const float kValue = 1.0;\n"); }

  /// Compiles with a new compiler, as a new process would, and tells what it did.
  CompileStatistics compile(const ShaderDefines& defines = {}) {
    ShaderCompiler compiler({.include_directories = {folder_.path()}, .cache_directory = cache()});
    const std::array stages{compute_source(text_)};
    words_ = compiler.compile(stages, defines)[0].words;
    return compiler.statistics();
  }

  [[nodiscard]] std::filesystem::path cache() const { return folder_.path() / "new" / "cache"; }

  [[nodiscard]] std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(cache())) files.push_back(entry.path());
    return files;
  }

  TemporaryFolder folder_;
  std::string text_ =
      "#include \"lib/value.glsl\"\nlayout(local_size_x = 1) in;\nlayout(std430) buffer R { float r; };\n"
      "void main() { r = kValue; }\n";
  std::vector<uint32_t> words_;
};

TEST_F(SpirvCache, TheSecondTimeComesFromTheCacheWithTheSameWords) {
  EXPECT_EQ(compile().compiled, 1u);
  const std::vector<uint32_t> first = words_;
  const CompileStatistics second = compile();
  EXPECT_EQ(second.compiled, 0u);
  EXPECT_EQ(second.from_cache, 1u);
  EXPECT_EQ(words_, first);
  EXPECT_EQ(entries().size(), 1u) << "an unfinished file was left behind";
}

TEST_F(SpirvCache, AChangedIncludeIsCompiledAnew) {
  compile();
  const std::vector<uint32_t> first = words_;
  folder_.write("lib/value.glsl", "const float kValue = 2.0;\n");
  EXPECT_EQ(compile().compiled, 1u);
  EXPECT_NE(words_, first);
}

TEST_F(SpirvCache, AChangedSourceOrDefineIsCompiledAnew) {
  compile();
  EXPECT_EQ(compile({{"A", "1"}}).compiled, 1u);
  EXPECT_EQ(compile({{"A", "2"}}).compiled, 1u);
  EXPECT_EQ(compile({{"A", "1"}}).from_cache, 1u);
  text_ += "\n";
  EXPECT_EQ(compile().compiled, 1u);
}

TEST_F(SpirvCache, ADamagedEntryIsRejectedAndReplaced) {
  compile();
  const std::vector<uint32_t> good = words_;
  const std::filesystem::path file = entries().front();
  const auto size = std::filesystem::file_size(file);
  const auto flip_byte_at = [&](std::uintmax_t offset) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(offset));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(offset));
    stream.put(static_cast<char>(byte ^ 0x10));
  };
  const std::vector<std::function<void()>> damages{
      [&] { std::filesystem::resize_file(file, 0); },
      [&] { std::filesystem::resize_file(file, 7); },
      [&] { std::filesystem::resize_file(file, size - 4); },
      [&] { std::filesystem::resize_file(file, size + 4); },
      [&] { flip_byte_at(0); },
      [&] { flip_byte_at(20); },
      [&] { flip_byte_at(size / 2); },
      [&] { flip_byte_at(size - 1); },
  };
  for (size_t i = 0; i < damages.size(); ++i) {
    damages[i]();
    const CompileStatistics after = compile();
    EXPECT_EQ(after.rejected_cache_entries, 1u) << "damage " << i;
    EXPECT_EQ(after.compiled, 1u) << "damage " << i;
    EXPECT_EQ(words_, good) << "damage " << i;
    EXPECT_EQ(compile().from_cache, 1u) << "damage " << i << " was not repaired";
  }
}

TEST_F(SpirvCache, AnEntryOfAnotherShaderUnderThisNameIsRejected) {
  compile();
  const std::filesystem::path file = entries().front();
  compile({{"OTHER", "1"}});
  for (const auto& other : entries()) {
    if (other != file) std::filesystem::copy_file(other, file, std::filesystem::copy_options::overwrite_existing);
  }
  EXPECT_EQ(compile().rejected_cache_entries, 1u);
}

TEST_F(SpirvCache, ACacheThatCannotBeWrittenIsToldAndDoesNotStopTheRun) {
  folder_.write("new/cache", "a file where the folder should be");
  const CompileStatistics statistics = compile();
  EXPECT_EQ(statistics.compiled, 1u);
  EXPECT_FALSE(statistics.cache_write_failure.empty());
  EXPECT_FALSE(words_.empty());
}

}  // namespace
}  // namespace lightloom::gpu
