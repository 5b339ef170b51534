#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "framework/base/diagnostics.hpp"
#include "framework/base/file.hpp"
#include "framework/base/limits.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/pass_description.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/link.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/stability/check.hpp"
#include "passes/registry.hpp"
#include "tests/support/source_dir.hpp"

// What the documents say is run: each fenced block of shell commands in a folder of its own, each graph through the
// compiler, each link to a file.
namespace lightloom {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = lightloom::source_dir();

struct Block {
  std::string language;
  std::string text;
  size_t line = 0;
};

std::vector<Block> fenced_blocks(const std::string& document) {
  std::vector<Block> blocks;
  bool inside = false;
  size_t number = 0;
  for (const std::string& line : split(document, '\n')) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) blocks.push_back({line.substr(3), "", number + 1});
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files = {kSource / "README.md", kSource / "samples/README.md"};
  for (const auto& entry : fs::directory_iterator(kSource / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string test_name(const ::testing::TestParamInfo<fs::path>& info) {
  std::string name = fs::relative(info.param, kSource).replace_extension().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

/// A folder that looks like a checkout to the commands, where what they write does no harm.
class Sandbox {
 public:
  Sandbox() {
    // The blank in the name is deliberate: users' folders have them.
    std::string name = (fs::temp_directory_path() / "lightloom docs XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    for (const char* entry : {"graphs", "samples", "docs", "run.sh", "test.sh"}) {
      fs::create_symlink(kSource / entry, folder_ / entry);
    }
    fs::create_directory(folder_ / "bin");
    fs::create_symlink(LIGHTLOOM_PROGRAM, folder_ / "bin/lightloom");
  }
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;
  ~Sandbox() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// Exit status of the commands, and all they print.
  std::pair<int, std::string> run(const std::string& commands) const {
    std::ofstream(folder_ / "commands.sh") << "set -e\n" << commands;
    const std::string line = "cd '" + folder_.string() + "' && PATH=\"$PWD/bin:$PATH\" LIGHTLOOM_BUILD='" +
                             LIGHTLOOM_BUILD_DIR + "' bash commands.sh >output.txt 2>&1 </dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text_file(folder_ / "output.txt")};
  }

 private:
  fs::path folder_;
};

/// The whole suite is what runs this test; the whole render has a test of its own, below.
bool is_whole_job(const std::string& text) {
  return text == "./run.sh\n" || text == "./test.sh\n";
}

class Documents : public ::testing::TestWithParam<fs::path> {};

TEST_P(Documents, every_command_works) {
  const Sandbox sandbox;
  for (const Block& block : fenced_blocks(read_text_file(GetParam()))) {
    if (block.language != "sh" || is_whole_job(block.text)) continue;
    const auto [status, output] = sandbox.run(block.text);
    EXPECT_EQ(status, 0) << GetParam() << ":" << block.line << "\n" << block.text << "\n" << output;
  }
}

TEST_P(Documents, every_graph_compiles) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  for (const Block& block : fenced_blocks(read_text_file(GetParam()))) {
    if (block.language != "json") continue;
    Diagnostics diagnostics;
    const auto spec = parse_graph(block.text, GetParam().string(), diagnostics);
    ASSERT_TRUE(spec.has_value());
    std::vector<std::vector<std::string>> choices = {{}};
    for (const VariantSpec& variant : spec->variants) choices.push_back({variant.name});
    for (const auto& variants : choices) {
      LinkOptions options;
      options.variants = variants;
      (void)link(*spec, registry, options, run::link_environment(nullptr), diagnostics);
    }
    for (const Diagnostic& problem : diagnostics.all()) ADD_FAILURE() << format_diagnostic(problem);
  }
}

TEST_P(Documents, every_link_leads_to_a_file) {
  const std::string text = read_text_file(GetParam());
  for (size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
    const std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
    if (target.starts_with("http") || target.starts_with('#')) continue;
    EXPECT_TRUE(fs::exists(GetParam().parent_path() / target)) << target;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Documents, ::testing::ValuesIn(documents()), test_name);

TEST(Docs, the_page_of_passes_is_what_the_program_prints) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  const std::vector<std::string> printed = split(cli::passes_markdown(registry), '\n');
  const std::vector<std::string> stored = split(read_text_file(kSource / "docs/passes.md"), '\n');
  const auto [one, other] = std::mismatch(printed.begin(), printed.end(), stored.begin(), stored.end());
  EXPECT_TRUE(one == printed.end() && other == stored.end())
      << "first difference in line " << one - printed.begin() + 1
      << "; write the page again: build/lightloom passes --markdown > docs/passes.md";
}

TEST(Docs, the_schemas_are_what_the_program_prints) {
  const Sandbox sandbox;
  for (const std::string format : {"graph", "scene", "study", "plan"}) {
    const auto [status, printed] = sandbox.run("lightloom schema " + format);
    ASSERT_EQ(status, 0) << printed;
    EXPECT_TRUE(printed == read_text_file(kSource / "docs" / (format + ".schema.json")))
        << "write it again: build/lightloom schema " << format << " --out docs/" << format << ".schema.json";
  }
}

TEST(Docs, the_table_of_stability_has_every_check) {
  const std::string table = read_text_file(kSource / "docs/stability.md");
  for (const stability::Check& check : stability::all_checks())
    EXPECT_NE(table.find("| `" + check.name + "` | " + check.extreme), std::string::npos)
        << check.name
        << "; make the table again: build/lightloom stability --slow --validate --markdown > docs/stability.md";
}

TEST(Docs, the_table_of_limits_is_that_of_the_code) {
  const std::string page = read_text_file(kSource / "docs/hostile_input.md");
  std::string rows = "| limit | default | what it holds for |\n| --- | --- | --- |\n";
  for (const LimitInfo& info : limit_table())
    rows += "| `" + std::string(info.name) + "` | " + std::to_string(Limits{}.*info.value) + " | " +
            std::string(info.doc) + " |\n";
  EXPECT_THAT(page, ::testing::HasSubstr(rows + "\n"));
}

TEST(Docs, the_first_graph_of_the_readme_is_the_sample) {
  std::string graph;
  for (const Block& block : fenced_blocks(read_text_file(kSource / "README.md"))) {
    if (block.language == "json") graph = block.text;
  }
  EXPECT_EQ(graph, read_text_file(kSource / "samples/graphs/first_graph.json"));
}

TEST(Docs, run_sh_without_arguments_renders_the_sample_scene) {
  const Sandbox sandbox;
  const auto [status, output] = sandbox.run("./run.sh");
  EXPECT_EQ(status, 0) << output;
  EXPECT_THAT(output, ::testing::HasSubstr("out/atrium/image.0009.png"));
  EXPECT_TRUE(fs::exists(kSource / "out/atrium/image.0009.png"));
}

// test.sh ends in a run of ctest, which this one is part of: so it is asked only for the list.
TEST(Docs, test_sh_passes_its_arguments_to_ctest) {
  const Sandbox sandbox;
  const auto [status, output] = sandbox.run("./test.sh --show-only");
  EXPECT_EQ(status, 0) << output;
  EXPECT_THAT(output, ::testing::HasSubstr("docs.Docs.test_sh_passes_its_arguments_to_ctest"));
}

TEST(Docs, run_sh_keeps_exit_codes_and_the_callers_folder) {
  const Sandbox sandbox;
  const auto expect_status = [&sandbox](int expected, const std::string& commands) {
    const auto [status, output] = sandbox.run(commands);
    EXPECT_EQ(status, expected) << commands << "\n" << output;
  };
  expect_status(2, "./run.sh nonsense");
  expect_status(0, "mkdir below; cd below; ../run.sh check ../graphs/paper.json");
  expect_status(3, "./run.sh check no/such.json");
}

TEST(Docs, every_command_of_the_program_is_documented) {
  const Sandbox sandbox;
  const std::string page = read_text_file(kSource / "docs/command_line.md");
  const auto [status, help] = sandbox.run("lightloom --help");
  ASSERT_EQ(status, 0);
  for (const char* command : {"render", "check", "plan", "passes", "schema", "scene", "brdf", "compare", "study", "new",
                              "devices", "completion"}) {
    EXPECT_THAT(help, ::testing::HasSubstr(std::string("\n  ") + command + " "));
    EXPECT_THAT(page, ::testing::HasSubstr(std::string("lightloom ") + command));
  }
}

}  // namespace
}  // namespace lightloom
