#include "framework/gpu/shader_compiler.hpp"

#include <array>

#include "framework/base/hash.hpp"
#include "framework/gpu/reflection.hpp"
#include "tests/gpu/gpu_support.hpp"

namespace lightloom::gpu {
namespace {

using test::compute_source;
using test::error_of;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kWriteValue = R"(
layout(local_size_x = 1) in;
layout(std430) buffer Result { float result; };
)";

std::vector<SpirvModule> compile(const ShaderSource& source, ShaderCompilerOptions options = {},
                                 const ShaderDefines& defines = {}) {
  ShaderCompiler compiler(std::move(options));
  return compiler.compile(std::span(&source, 1), defines);
}

TEST(ShaderCompiler, MakesSpirv16) {
  const auto modules = compile(compute_source("layout(local_size_x = 1) in;\nvoid main() {}\n"));
  ASSERT_EQ(modules.size(), 1u);
  ASSERT_GT(modules[0].words.size(), 5u);
  EXPECT_EQ(modules[0].words[0], 0x07230203u);
  EXPECT_EQ(modules[0].words[1], 0x00010600u);
}

TEST(ShaderCompiler, NotesWhatItReadAndWhereItLookedInVain) {
  const TemporaryFolder own;
  const TemporaryFolder program;
  const std::string shader = "#include \"lib/a.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() { f(); }\n";
  program.write("x.comp", shader);
  program.write("lib/a.glsl", "#include \"b.glsl\"\nvoid f() {}\n");
  own.write("b.glsl", "// nothing\n");
  ShaderCompiler compiler({.include_directories = {own.path(), program.path()}, .cache_directory = {}});
  const std::vector<std::string> files{"x.comp"};
  static_cast<void>(compiler.compile_files(files));
  const FileContents expected{{own.path() / "x.comp", std::nullopt},
                              {program.path() / "x.comp", content_of(program.path() / "x.comp")},
                              {own.path() / "lib/a.glsl", std::nullopt},
                              {program.path() / "lib/a.glsl", content_of(program.path() / "lib/a.glsl")},
                              {own.path() / "b.glsl", content_of(own.path() / "b.glsl")}};
  EXPECT_EQ(compiler.files_read(), expected);
  EXPECT_EQ(expected.at(program.path() / "x.comp"), hash_text(shader));
  program.write("x.comp", "#include \"gone.glsl\"\nvoid main() { oops; }\n");
  EXPECT_THROW(static_cast<void>(compiler.compile_files(files)), Error);
  EXPECT_TRUE(compiler.files_read().contains(program.path() / "gone.glsl")) << "so that making it is noticed";
  EXPECT_FALSE(compiler.files_read().contains(own.path() / "b.glsl")) << "of the last call alone";
}

TEST(ShaderCompiler, IsDeterministic) {
  const ShaderSource source = compute_source(std::string(kWriteValue) + "void main() { result = sin(result); }");
  EXPECT_EQ(compile(source)[0].words, compile(source)[0].words);
}

TEST(ShaderCompiler, AnErrorNamesFileAndLineAndListsTheOthers) {
  const Error error =
      error_of([] { compile(compute_source("#version 460\nvoid main() {\n  unknown_a = 1;\n  unknown_b = 2;\n}\n")); });
  EXPECT_EQ(error.code(), ExitCode::invalid_input);
  EXPECT_THAT(error.what(), AllOf(HasSubstr("test.comp:3: 'unknown_a'"), Not(HasSubstr("unknown_b"))));
  EXPECT_THAT(error.hint(), HasSubstr("test.comp:4: 'unknown_b'"));
}

TEST(ShaderCompiler, LinesCountFromOneWithoutAVersionToo) {
  EXPECT_THAT(error_of([] { compile(compute_source("void main() { oops; }\n")); }).what(), HasSubstr("test.comp:1: "));
}

TEST(ShaderCompiler, AnErrorInAnIncludedFileNamesThatFile) {
  const TemporaryFolder folder;
  folder.write("lib/outer.glsl", "#include \"lib/inner.glsl\"\n");
  folder.write("lib/inner.glsl", "float fine() { return 1.0; }\n\nfloat broken() { return nothing; }\n");
  const ShaderSource source = compute_source("#include \"lib/outer.glsl\"\nvoid main() {}\n");
  EXPECT_THAT(
      error_of([&] { compile(source, {.include_directories = {folder.path()}, .cache_directory = {}}); }).what(),
      HasSubstr("lib/inner.glsl:3: 'nothing'"));
}

TEST(ShaderCompiler, AnErrorAfterAnIncludeKeepsItsLine) {
  const TemporaryFolder folder;
  folder.write("lib/a.glsl", "\n\n\n\nconst float k = 1.0;\n");
  const ShaderSource source = compute_source("#include \"lib/a.glsl\"\n\nvoid main() { nothing; }\n");
  EXPECT_THAT(
      error_of([&] { compile(source, {.include_directories = {folder.path()}, .cache_directory = {}}); }).what(),
      HasSubstr("test.comp:3: 'nothing'"));
}

TEST(ShaderCompiler, EarlierIncludeDirectoriesWin) {
  const TemporaryFolder first;
  const TemporaryFolder second;
  first.write("lib/a.glsl", "float both() { return 1.0; }\n");
  second.write("lib/a.glsl", "this is no GLSL\n");
  second.write("lib/b.glsl", "float only_second() { return 2.0; }\n");
  const ShaderSource source = compute_source(std::string("#include \"lib/a.glsl\"\n#include \"lib/b.glsl\"\n") +
                                             kWriteValue + "void main() { result = both() + only_second(); }");
  EXPECT_NO_THROW(compile(source, {.include_directories = {first.path(), second.path()}, .cache_directory = {}}));
}

TEST(ShaderCompiler, AMissingIncludeNamesItsLineAndTheFolders) {
  const TemporaryFolder folder;
  const Error error = error_of([&] {
    compile(compute_source("void main() {}\n#include \"lib/none.glsl\"\n"),
            {.include_directories = {folder.path()}, .cache_directory = {}});
  });
  EXPECT_THAT(std::string(error.what()) + error.hint(),
              AllOf(HasSubstr("test.comp:2"), HasSubstr("lib/none.glsl"), HasSubstr(folder.path().string())));
}

TEST(ShaderCompiler, AMissingIncludeThatNoConditionReachesIsFine) {
  EXPECT_NO_THROW(compile(
      compute_source("#if 0\n#include \"lib/none.glsl\"\n#endif\nlayout(local_size_x = 1) in;\nvoid main() {}\n")));
}

TEST(ShaderCompiler, AnIncludeCycleIsAnErrorThatPrintsIt) {
  const TemporaryFolder folder;
  folder.write("lib/a.glsl", "#include \"lib/b.glsl\"\n");
  folder.write("lib/b.glsl", "  #  include \"lib/a.glsl\"\n");
  const Error error = error_of([&] {
    compile(compute_source("#include \"lib/a.glsl\"\nvoid main() {}\n"),
            {.include_directories = {folder.path()}, .cache_directory = {}});
  });
  EXPECT_EQ(error.code(), ExitCode::invalid_input);
  EXPECT_THAT(error.what(), HasSubstr("lib/a.glsl -> lib/b.glsl -> lib/a.glsl"));
}

TEST(ShaderCompiler, DefinesReachTheShader) {
  const ShaderSource source = compute_source(
      "#ifndef WIDTH\n#error no width\n#endif\n"
      "layout(local_size_x = WIDTH) in;\nvoid main() {}\n");
  EXPECT_EQ(reflect(compile(source, {}, {{"WIDTH", "48"}})).local_size[0], 48u);
  EXPECT_THAT(error_of([&] { compile(source); }).what(), HasSubstr("no width"));
}

TEST(ShaderCompiler, FilesAreFoundAndTheirStageToldByExtension) {
  const TemporaryFolder folder;
  folder.write("a.vert", "void main() { gl_Position = vec4(0); }\n");
  folder.write("a.frag", "out vec4 out_color;\nvoid main() { out_color = vec4(1); }\n");
  ShaderCompiler compiler({.include_directories = {folder.path()}, .cache_directory = {}});
  const std::array<std::string, 2> files{"a.vert", "a.frag"};
  const auto modules = compiler.compile_files(files);
  ASSERT_EQ(modules.size(), 2u);
  EXPECT_EQ(modules[0].stage, Stage::vertex);
  EXPECT_EQ(modules[1].stage, Stage::fragment);
  const std::array<std::string, 1> missing{"none.comp"};
  EXPECT_THAT(error_of([&] { static_cast<void>(compiler.compile_files(missing)); }).what(),
              HasSubstr("there is no shader 'none.comp'"));
  const std::array<std::string, 1> unknown{"a.glsl"};
  EXPECT_THAT(error_of([&] { static_cast<void>(compiler.compile_files(unknown)); }).hint(), HasSubstr("*.comp"));
}

TEST(ShaderCompiler, StagesThatMakeNoPipelineAreAnError) {
  ShaderCompiler compiler({});
  const std::array<ShaderSource, 1> lone{ShaderSource{"a.vert", "void main() {}", Stage::vertex}};
  EXPECT_THAT(error_of([&] { static_cast<void>(compiler.compile(lone)); }).what(),
              HasSubstr("a vertex and a fragment shader"));
}

TEST(ShaderCompiler, AFragmentInputThatNobodyWritesIsAnError) {
  ShaderCompiler compiler({});
  const std::array<ShaderSource, 2> stages{
      ShaderSource{"a.vert", "out vec2 uv;\nvoid main() { uv = vec2(0); gl_Position = vec4(0); }", Stage::vertex},
      ShaderSource{"a.frag", "in vec2 uw;\nout vec4 o;\nvoid main() { o = uw.xyxy; }", Stage::fragment}};
  const Error error = error_of([&] { static_cast<void>(compiler.compile(stages)); });
  EXPECT_THAT(error.what(), AllOf(HasSubstr("a.vert + a.frag"), HasSubstr("uw")));
}

TEST(ShaderCompiler, ARecursionIsAnErrorAndNoCrash) {
  EXPECT_THAT(
      error_of([] {
        compile(compute_source(std::string(kWriteValue) + "float f(float x);\nfloat g(float x) { return f(x); }\n"
                                                          "float f(float x) { return x > 1.0 ? g(x - 1.0) : x; }\n"
                                                          "void main() { result = f(result); }"));
      }).what(),
      HasSubstr("test.comp"));
}

// What a user's editor may hand us: every one must end in an Error, never in a crash.
TEST(ShaderCompiler, BrokenTextIsAnError) {
  for (const char* text :
       {"", "\n", "void main() {", "}", "#include", "#include \"", "#include <a>\nvoid main() {}",
        "#version 999\nvoid main() {}", "layout(local_size_x = 0) in;\nvoid main() {}",
        "void main() { int a[-1]; a[0] = 1; }", "#error stop\n", "struct S { S s; };\nvoid main(){}", "\xff\xfe\x01",
        "void main() { for (;; }", "int f() { return f; }\nvoid main() { f(); f = 1; }"}) {
    EXPECT_EQ(error_of([&] { compile(compute_source(text)); }).code(), ExitCode::invalid_input) << text;
  }
}

}  // namespace
}  // namespace lightloom::gpu
