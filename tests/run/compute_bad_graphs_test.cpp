// Every mistake with a pass of type `compute` has its diagnostic, at its place: tests/graphs_bad/compute.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "framework/base/file.hpp"
#include "framework/base/json.hpp"
#include "framework/run/compile_graph.hpp"
#include "passes/registry.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = source_dir() / "tests" / "graphs_bad" / "compute";

/// "line:column code" of all that is wrong, sorted by place, and their text.
std::vector<std::string> problems_of(const fs::path& file, std::string& text) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  Diagnostics diagnostics;
  EXPECT_FALSE(compile_graph(file, registry, {}, nullptr, diagnostics).has_value()) << file;
  std::vector<std::string> problems;
  for (const Diagnostic& problem : diagnostics.sorted()) {
    problems.push_back(std::to_string(problem.where.line) + ":" + std::to_string(problem.where.column) + " " +
                       problem.code);
    EXPECT_FALSE(problem.message.empty() || problem.message.back() == '.') << problem.message;
    EXPECT_EQ(problem.message.find('\n'), std::string::npos) << problem.message;
    text += format_diagnostic(problem) + "\n";
  }
  return problems;
}

/// expected.json: {"FILE": ["LINE:COLUMN CODE", …], …}, sorted by place.
std::map<std::string, std::vector<std::string>> expected() {
  Diagnostics diagnostics;
  const std::optional<JsonNode> root =
      parse_json(read_text_file(kFolder / "expected.json"), "expected.json", diagnostics);
  std::map<std::string, std::vector<std::string>> files;
  for (const JsonMember& member : root.value().members)
    for (const JsonNode& problem : member.value.elements) files[member.key].push_back(problem.string);
  return files;
}

TEST(ComputeBadGraphs, AllAndOnlyTheExpectedDiagnostics) {
  const auto files = expected();
  EXPECT_GT(files.size(), 20U);
  for (const auto& [file, problems] : files) {
    std::string text;
    EXPECT_EQ(problems_of(kFolder / file, text), problems) << file << "\n" << text;
  }
}

TEST(ComputeBadGraphs, EveryFileIsListed) {
  const auto listed = expected();
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(entry.path().extension() == ".comp" || name == "expected.json" || listed.contains(name)) << name;
  }
}

TEST(ComputeBadGraphs, TheLineOfTheShaderIsNamed) {
  const std::vector<std::pair<std::string, std::string>> places = {
      {"syntax", "syntax.comp:6: 'brightness' : undeclared identifier"},
      {"buffer", "buffer.comp:4: 'Table' is a storage buffer"},
      {"sampler", "sampler.comp:3: 'radiance' is an image with sampler"},
      {"written_input", "written_input.comp:3: 'radiance' may be written"},
      {"read_output", "read_output.comp:3: 'out_radiance' is read as well as written"},
      {"vector", "vector.comp:4: push constant 'tint' cannot be a param"},
      {"missing_param", "param 'amount', a float at "},
      {"missing_param", "scale.comp:5"},
      {"outputs", "rgba16_sfloat at "},
      {"outputs", "scale.comp:4"}};
  for (const auto& [file, place] : places) {
    std::string text;
    (void)problems_of(kFolder / (file + ".json"), text);
    EXPECT_THAT(text, testing::HasSubstr(place));
  }
}

}  // namespace
}  // namespace lightloom::run
