#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "framework/base/text.hpp"
#include "framework/cli/text_layout.hpp"
#include "tests/cli/sample_program.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

const Command& command(const SampleProgram& sample, const std::string& name) {
  for (const Command* candidate : sample.program.commands()) {
    if (candidate->name() == name) return *candidate;
  }
  throw std::logic_error(name);
}

TEST(ArgumentHelp, shows_usage_arguments_groups_and_defaults) {
  const SampleProgram sample;
  const std::string help = command(sample, "render").help();
  EXPECT_THAT(help, HasSubstr("Render frames of a graph\n\nUsage: lightloom render [OPTIONS] GRAPH --scene FILE\n"));
  EXPECT_THAT(help, HasSubstr("\nArguments:\n  GRAPH                       Graph file\n"));
  EXPECT_THAT(help, HasSubstr("\nScene:\n      --scene FILE            Scene file [required]\n"));
  EXPECT_THAT(help, HasSubstr("      --size WxH              View size\n"));
  EXPECT_THAT(help, HasSubstr("--frames A..B           Frames to render [default: 0]"));
  EXPECT_THAT(help, HasSubstr("  -n, --count N               How many"));
  EXPECT_THAT(help, HasSubstr("of a help text [1 to 16;\n                              default: 1]"));
  EXPECT_THAT(help, HasSubstr("[one of: slow, fast; default: slow]"));
  EXPECT_THAT(help, HasSubstr("--set NAME=VALUE        Sets a parameter [can be repeated]"));
  EXPECT_TRUE(help.ends_with("  -h, --help                  Show this help\n")) << help;
}

TEST(ArgumentHelp, no_line_is_wider_than_100_columns) {
  const SampleProgram sample;
  for (const Command* each : sample.program.commands()) {
    for (const std::string& line : split(each->help(), '\n')) EXPECT_LE(display_width(line), 100u) << line;
  }
}

TEST(ArgumentHelp, the_program_lists_its_commands) {
  const SampleProgram sample;
  const std::string help = sample.program.help();
  EXPECT_THAT(help, HasSubstr("Usage: lightloom COMMAND"));
  for (const Command* each : sample.program.commands()) {
    EXPECT_THAT(help, HasSubstr("  " + each->name()));
    EXPECT_THAT(help, HasSubstr(each->summary()));
  }
  EXPECT_THAT(help, HasSubstr("--version"));
}

TEST(TextLayout, wrap_breaks_at_blanks_and_indents) {
  EXPECT_EQ(wrap("aa bb cc", 5, 2), "aa bb\n  cc");
  EXPECT_EQ(wrap("aa bb", 5, 0, 3), "aa\nbb");
  EXPECT_EQ(wrap("longer-than-a-line a", 5, 0), "longer-than-a-line\na");
  EXPECT_EQ(wrap("a\nb", 80, 1), "a\n b");
  EXPECT_EQ(wrap("", 80, 1), "");
  EXPECT_EQ(wrap("éé éé", 5, 0), "éé éé");
}

TEST(TextLayout, columns_are_aligned_by_characters_not_bytes) {
  EXPECT_EQ(align_columns({{"a", "b"}, {"éé", "c"}, {"x"}}), "a   b\néé  c\nx\n");
}

/// Loads the script into a real bash and completes the last of `words`.
std::vector<std::string> complete(const std::vector<std::string>& words, const std::filesystem::path& folder = ".") {
  const SampleProgram sample;
  std::string script = sample.program.bash_completion();
  script += "cd '" + folder.string() + "'\nCOMP_WORDS=(";
  for (const std::string& word : words) script += "'" + word + "' ";
  script += ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) + "\n_lightloom\n";
  script += "for reply in \"${COMPREPLY[@]}\"; do echo \"$reply\"; done\n";
  std::string file = (std::filesystem::temp_directory_path() / "lightloom_completion_XXXXXX").string();
  const int descriptor = mkstemp(file.data());
  EXPECT_GE(descriptor, 0);
  std::ofstream(file) << script;
  std::vector<std::string> replies;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(("bash --norc " + file + " 2>&1").c_str(), "r"), pclose);
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
    replies.emplace_back(line.data());
    replies.back().pop_back();
  }
  std::filesystem::remove(file);
  return replies;
}

TEST(BashCompletion, completes_commands_options_and_choices) {
  EXPECT_THAT(complete({"lightloom", "re"}), ElementsAre("render"));
  EXPECT_THAT(complete({"lightloom", "c"}), UnorderedElementsAre("check", "completion"));
  EXPECT_THAT(complete({"lightloom", "--v"}), ElementsAre("--version"));
  EXPECT_THAT(complete({"lightloom", "render", "--s"}), UnorderedElementsAre("--scene", "--size", "--seed", "--set"));
  EXPECT_THAT(complete({"lightloom", "render", "g", "--mode", "f"}), ElementsAre("fast"));
  EXPECT_THAT(complete({"lightloom", "render", "g", "--mode", "=", "f"}), ElementsAre("fast"));
  EXPECT_THAT(complete({"lightloom", "render", "g", "--mode", "="}), UnorderedElementsAre("slow", "fast"));
  EXPECT_THAT(complete({"lightloom", "completion", ""}), ElementsAre("bash"));
  EXPECT_THAT(complete({"lightloom", "render", "--size", ""}), ElementsAre());
}

TEST(BashCompletion, completes_files_where_a_file_is_expected) {
  EXPECT_THAT(complete({"lightloom", "render", "--scene", "CMakeL"}, source_dir().string()),
              ElementsAre("CMakeLists.txt"));
  EXPECT_THAT(complete({"lightloom", "render", "CMakeL"}, source_dir().string()), ElementsAre("CMakeLists.txt"));
}

}  // namespace
}  // namespace lightloom::cli
