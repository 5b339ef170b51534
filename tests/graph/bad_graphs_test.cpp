#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/base/file.hpp"
#include "framework/base/json.hpp"
#include "passes/registry.hpp"
#include "tests/graph/fixed_registry.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

const std::filesystem::path kFolder = source_dir() / "tests" / "graphs_bad";

/// "line:column code"
std::string place_and_code(const SourceLocation& where, const std::string& code) {
  return std::to_string(where.line) + ":" + std::to_string(where.column) + " " + code;
}

std::vector<std::string> found_in(const std::string& name, const PassRegistry& types, std::string& text) {
  const toy::Result result = toy::link_text(read_text_file(kFolder / name), {}, types);
  std::vector<std::string> found;
  for (const Diagnostic& diagnostic : result.diagnostics.sorted()) {
    found.push_back(place_and_code(diagnostic.where, diagnostic.code));
    EXPECT_FALSE(diagnostic.message.empty() || diagnostic.message.back() == '.') << diagnostic.message;
    EXPECT_EQ(diagnostic.message.find('\n'), std::string::npos) << diagnostic.message;
  }
  EXPECT_EQ(result.graph.has_value(), !result.diagnostics.has_errors());
  text = result.text();
  return found;
}

/// expected.json: {"FILE": ["LINE:COLUMN CODE", …], …}, sorted by place.
JsonNode read_expected() {
  Diagnostics diagnostics;
  std::optional<JsonNode> expected =
      parse_json(read_text_file(kFolder / "expected.json"), "expected.json", diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
  return expected.value_or(JsonNode{});
}

std::vector<std::string> expected_of(const JsonMember& member) {
  std::vector<std::string> expected;
  for (const JsonNode& element : member.value.elements) expected.push_back(element.string);
  return expected;
}

TEST(BadGraphs, AllAndOnlyTheExpectedDiagnostics) {
  const JsonNode expected = read_expected();
  for (const JsonMember& member : expected.members) {
    std::string text;
    EXPECT_EQ(found_in(member.key, toy::fixed_registry(), text), expected_of(member)) << member.key << "\n" << text;
    EXPECT_FALSE(member.value.elements.empty()) << member.key;
  }
  EXPECT_GT(expected.members.size(), 30U);
}

TEST(BadGraphs, EveryFileIsListed) {
  const JsonNode expected = read_expected();
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.is_directory()) continue;  // graphs with shaders, which are compiled before they are linked
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "expected.json" || expected.find(name) != nullptr) << name;
  }
}

/// The real passes may change, but every mistake must show with them too.
TEST(BadGraphs, ShowWithTheRealPasses) {
  PassRegistry types;
  passes::register_builtin_passes(types);
  const JsonNode expected = read_expected();
  for (const JsonMember& member : expected.members) {
    std::string text;
    const std::vector<std::string> found = found_in(member.key, types, text);
    for (const std::string& problem : expected_of(member)) {
      const bool found_too = std::find(found.begin(), found.end(), problem) != found.end();
      EXPECT_TRUE(found_too) << member.key << " " << problem << "\n" << text;
    }
  }
}

}  // namespace
}  // namespace lightloom
