// Odd shader files: each compiles as it would in any editor's format, or ends in one clear error, and never in a hang.
#include <sys/stat.h>

#include <array>
#include <chrono>

#include "framework/gpu/shader_compiler.hpp"
#include "tests/gpu/gpu_support.hpp"

namespace lightloom::gpu {
namespace {

namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kGood = "layout(local_size_x = 1) in;\nlayout(std430) buffer R { float r; };\n";
constexpr const char* kMark = "\xEF\xBB\xBF";

class ShaderText : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<uint32_t> compile(const std::string& file = "a.comp") const {
    ShaderCompiler compiler({.include_directories = {folder_.path()}, .cache_directory = {}});
    const std::array files{file};
    return compiler.compile_files(files)[0].words;
  }
  [[nodiscard]] std::vector<uint32_t> compile_text(const std::string& text) const {
    folder_.write("a.comp", text);
    return compile();
  }
  /// The error and its hint; the compiler has to be done with it soon.
  [[nodiscard]] std::string problem(const std::string& text) const {
    folder_.write("a.comp", text);
    return problem();
  }
  [[nodiscard]] std::string problem() const {
    const auto begin = std::chrono::steady_clock::now();
    const Error error = test::error_of([&] { static_cast<void>(compile()); });
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }

  test::TemporaryFolder folder_;
};

std::string with_ends(const std::string& text, const std::string& end) {
  std::string made;
  for (const char c : text) made += c == '\n' ? end : std::string(1, c);
  return made;
}

TEST_F(ShaderText, AByteOrderMarkIsNoText) {
  folder_.write("value.glsl", "const float kValue = 2.0;\n");
  const std::string text = std::string("#include \"value.glsl\"\n") + kGood + "void main() { r = kValue; }\n";
  const std::vector<uint32_t> plain = compile_text(text);
  EXPECT_EQ(compile_text(kMark + text), plain);
  folder_.write("value.glsl", std::string(kMark) + "const float kValue = 2.0;\n");
  EXPECT_EQ(compile_text(kMark + text), plain);
  EXPECT_THAT(problem(std::string(kMark) + "#version 460\nvoid main() { oops; }\n"), HasSubstr("a.comp:2: 'oops'"));
}

TEST_F(ShaderText, LinesMayEndAsOnAnySystem) {
  const std::string included = "// a comment\nconst float kValue = 2.0;\n";
  const std::string text =
      std::string("#version 460\n#include \"value.glsl\"\n") + kGood + "void main() { r = kValue; }\n";
  folder_.write("value.glsl", included);
  const std::vector<uint32_t> plain = compile_text(text);
  for (const char* end : {"\r\n", "\r"}) {
    folder_.write("value.glsl", with_ends(included, end));
    EXPECT_EQ(compile_text(with_ends(text, end)), plain);
  }
  EXPECT_THAT(problem(with_ends(text + "oops\n", "\r\n")), HasSubstr("a.comp:6"));
}

TEST_F(ShaderText, WithoutALastLineEndItIsWhole) {
  folder_.write("value.glsl", "const float kValue = 2.0;");
  EXPECT_FALSE(compile_text(std::string(kGood) + "#include \"value.glsl\"\nvoid main() { r = kValue; }").empty());
}

TEST_F(ShaderText, AFolderOrAPipeIsNoShader) {
  fs::create_directory(folder_.path() / "a.comp");
  EXPECT_THAT(problem(), AllOf(HasSubstr("a.comp"), HasSubstr("is no regular file")));
  fs::remove(folder_.path() / "a.comp");
  ASSERT_EQ(mkfifo((folder_.path() / "a.comp").c_str(), 0600), 0);
  EXPECT_THAT(problem(), AllOf(HasSubstr("a.comp"), HasSubstr("is no regular file")));
}

TEST_F(ShaderText, AFolderOrAPipeCannotBeIncluded) {
  fs::create_directory(folder_.path() / "folder.glsl");
  ASSERT_EQ(mkfifo((folder_.path() / "pipe.glsl").c_str(), 0600), 0);
  for (const std::string name : {"folder.glsl", "pipe.glsl"})
    EXPECT_THAT(problem("\n#include \"" + name + "\"\nvoid main() {}\n"),
                AllOf(HasSubstr("a.comp:2"), HasSubstr(name)));
}

TEST_F(ShaderText, AFileOfAbsurdSizeIsNotRead) {
  folder_.write("a.comp", "");
  fs::resize_file(folder_.path() / "a.comp", uintmax_t{1} << 40);
  EXPECT_THAT(problem(), AllOf(HasSubstr("a.comp"), HasSubstr("1099511627776 bytes, expected at most 16777216")));
  folder_.write("huge.glsl", "");
  fs::resize_file(folder_.path() / "huge.glsl", uintmax_t{1} << 40);
  EXPECT_THAT(problem("#include \"huge.glsl\"\nvoid main() {}\n"),
              AllOf(HasSubstr("huge.glsl"), HasSubstr("expected at most 16777216")));
}

TEST_F(ShaderText, OneThatIncludesItselfIsToldTheCycle) {
  EXPECT_THAT(problem("#include \"a.comp\"\nvoid main() {}\n"), HasSubstr("a.comp -> a.comp"));
  folder_.write("self.glsl", "#ifndef ONCE\n#define ONCE\n#include \"self.glsl\"\n#endif\n");
  EXPECT_THAT(problem("#include \"self.glsl\"\nvoid main() {}\n"), HasSubstr("self.glsl -> self.glsl"));
}

TEST_F(ShaderText, IncludesThatMultiplyComeToAnEnd) {
  // Sixty files, each including the next one twice: 2^60 in all, and no cycle.
  for (int i = 0; i < 60; ++i) {
    const std::string next = "#include \"f" + std::to_string(i + 1) + ".glsl\"\n";
    folder_.write("f" + std::to_string(i) + ".glsl", next + next);
  }
  folder_.write("f60.glsl", "\n");
  EXPECT_THAT(problem("#include \"f0.glsl\"\nvoid main() {}\n"),
              AllOf(HasSubstr("f59.glsl:"), HasSubstr("more is included than 10000 files or 16777216 bytes")));
}

TEST_F(ShaderText, LargeIncludesThatMultiplyComeToAnEnd) {
  folder_.write("large.glsl", "// " + std::string(1 << 20, 'x') + "\n");
  std::string text;
  for (int i = 0; i < 100; ++i) text += "#include \"large.glsl\"\n";
  EXPECT_THAT(problem(text + "void main() {}\n"), AllOf(HasSubstr("a.comp:16:"), HasSubstr("more is included")));
}

TEST_F(ShaderText, IncludesThatAreNestedTooDeepAreRefused) {
  constexpr int kFiles = 20'000;
  for (int i = 0; i < kFiles; ++i)
    folder_.write("f" + std::to_string(i) + ".glsl", "#include \"f" + std::to_string(i + 1) + ".glsl\"\n");
  folder_.write("f" + std::to_string(kFiles) + ".glsl", "\n");
  EXPECT_THAT(problem("#include \"f0.glsl\"\nvoid main() {}\n"),
              HasSubstr("includes files nested more than 100 deep, the last of them 'f100.glsl'"));
  EXPECT_FALSE(compile_text(std::string("#include \"f") + std::to_string(kFiles - 98) + ".glsl\"\n" + kGood +
                            "void main() { r = 1.0; }\n")
                   .empty());
}

TEST_F(ShaderText, WithoutAnEntryPointItSaysSo) {
  for (const std::string& text : {std::string(), std::string("\n\n"), std::string(kMark), std::string(kGood),
                                  kGood + std::string("void Main() { r = 1.0; }\n")})
    EXPECT_THAT(problem(text), AllOf(HasSubstr("a.comp"), HasSubstr("Missing entry point"))) << text;
}

TEST_F(ShaderText, BytesThatAreNoTextAreAnErrorOfTheirLine) {
  EXPECT_THAT(problem(kGood + std::string("\x01\x02 void main() {}\n")), HasSubstr("a.comp:3"));
  EXPECT_THAT(problem(kGood + std::string("\0void main() { r = 1.0; }\n", 25)), HasSubstr("a.comp"));
  EXPECT_THAT(problem("\xFF\xFEl\0a\0y\0"), HasSubstr("a.comp:1"));
}

}  // namespace
}  // namespace lightloom::gpu
