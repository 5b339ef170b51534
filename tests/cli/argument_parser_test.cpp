#include "framework/cli/argument_parser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/cli/sample_program.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Kind = ParseResult::Kind;

std::vector<std::string> messages(const ParseResult& result) {
  std::vector<std::string> texts;
  for (const Problem& problem : result.problems) texts.push_back(problem.message);
  return texts;
}

TEST(ArgumentParser, options_positionals_and_flags_reach_their_targets) {
  SampleProgram sample;
  const ParseResult result =
      sample.program.parse({"render", "paper.json", "--scene", "a.gltf", "--size=64x32", "-n", "3", "--frames", "2..5",
                            "--set", "a=1", "--json", "--set", "b.c=-2", "--gain", "-0.5", "--mode=fast"});
  EXPECT_THAT(messages(result), IsEmpty());
  EXPECT_EQ(result.kind, Kind::run);
  EXPECT_EQ(result.command->path(), "lightloom render");
  EXPECT_EQ(sample.graph, "paper.json");
  EXPECT_EQ(sample.scene, "a.gltf");
  EXPECT_EQ(sample.size, (Size{64, 32}));
  EXPECT_EQ(sample.count, 3u);
  EXPECT_EQ(sample.frames, (Range{2, 5}));
  EXPECT_THAT(sample.sets, ElementsAre(Assignment{"a", "1"}, Assignment{"b.c", "-2"}));
  EXPECT_EQ(sample.gain, -0.5);
  EXPECT_EQ(sample.mode, "fast");
  EXPECT_TRUE(sample.json);
}

TEST(ArgumentParser, what_is_not_given_keeps_its_default) {
  SampleProgram sample;
  EXPECT_EQ(sample.program.parse({"render", "g", "--scene=s"}).kind, Kind::run);
  EXPECT_EQ(sample.count, 1u);
  EXPECT_FALSE(sample.size.has_value());
  EXPECT_FALSE(sample.json);
}

TEST(ArgumentParser, four_ways_to_write_a_value) {
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{"-n", "4"}, {"-n4"}, {"-n=4"}, {"--count", "4"}, {"--count=4"}}) {
    SampleProgram sample;
    std::vector<std::string> line = {"render", "g", "--scene", "s"};
    line.insert(line.end(), arguments.begin(), arguments.end());
    EXPECT_THAT(messages(sample.program.parse(line)), IsEmpty()) << arguments.front();
    EXPECT_EQ(sample.count, 4u) << arguments.front();
  }
}

TEST(ArgumentParser, options_may_stand_before_and_after_positionals) {
  SampleProgram sample;
  EXPECT_EQ(sample.program.parse({"render", "--scene", "s", "g", "--json"}).kind, Kind::run);
  EXPECT_EQ(sample.graph, "g");
}

TEST(ArgumentParser, two_dashes_end_the_options) {
  SampleProgram sample;
  EXPECT_EQ(sample.program.parse({"check", "--json", "--", "--odd-name.json", "-n", "--"}).kind, Kind::run);
  EXPECT_THAT(sample.graphs, ElementsAre("--odd-name.json", "-n", "--"));
}

TEST(ArgumentParser, negative_numbers_are_values_and_positionals) {
  SampleProgram sample;
  EXPECT_EQ(sample.program.parse({"check", "-1", "-.5", "-2e3", "-"}).kind, Kind::run);
  EXPECT_THAT(sample.graphs, ElementsAre("-1", "-.5", "-2e3", "-"));
  EXPECT_EQ(sample.program.parse({"render", "g", "--scene=s", "--gain", "-1e-3"}).kind, Kind::run);
  EXPECT_EQ(sample.gain, -1e-3);
}

TEST(ArgumentParser, an_equals_sign_gives_any_value_even_an_empty_one) {
  SampleProgram sample;
  EXPECT_EQ(sample.program.parse({"render", "g", "--scene=--s=t", "--note="}).kind, Kind::run);
  EXPECT_EQ(sample.scene, "--s=t");
  EXPECT_EQ(sample.note, "");
}

TEST(ArgumentParser, all_problems_of_a_line_are_reported_in_order) {
  SampleProgram sample;
  const ParseResult result = sample.program.parse(
      {"render", "g", "extra", "--sceen", "s", "--size", "12", "--count=99", "--mode", "fats", "--json=1", "--seed"});
  EXPECT_EQ(result.kind, Kind::problems);
  EXPECT_THAT(messages(result), ElementsAre("unexpected argument 'extra'", "'lightloom render' has no option '--sceen'",
                                            "option '--size': expected WIDTHxHEIGHT such as 640x480, got '12'",
                                            "option '--count': expected a value from 1 to 16, got '99'",
                                            "option '--mode': 'fats' is not one of its choices",
                                            "option '--json' takes no value", "option '--seed' needs a value (N)"));
  EXPECT_EQ(result.problems[1].hint, "did you mean '--scene'?");
  EXPECT_EQ(result.problems[4].hint, "did you mean 'fast'?");
}

TEST(ArgumentParser, a_misspelt_option_takes_its_value_along) {
  SampleProgram sample;
  const ParseResult result = sample.program.parse({"render", "--sceen", "s.gltf", "g"});
  EXPECT_THAT(messages(result), ElementsAre("'lightloom render' has no option '--sceen'"));
  EXPECT_EQ(sample.graph, "g");
}

TEST(ArgumentParser, an_unknown_option_far_from_all_points_to_the_help) {
  SampleProgram sample;
  const ParseResult result = sample.program.parse({"render", "g", "--scene=s", "--quality", "high"});
  ASSERT_THAT(messages(result), ElementsAre("'lightloom render' has no option '--quality'"));
  EXPECT_EQ(result.problems[0].hint, "'lightloom render --help' lists the options");
}

TEST(ArgumentParser, a_missing_value_is_reported_and_the_next_option_still_read) {
  SampleProgram sample;
  const ParseResult result = sample.program.parse({"render", "g", "--scene", "--json"});
  EXPECT_THAT(messages(result), ElementsAre("option '--scene' needs a value (FILE)"));
  EXPECT_TRUE(sample.json);
  const ParseResult dashed = sample.program.parse({"render", "g", "--scene=s", "--note", "-x-"});
  ASSERT_EQ(dashed.problems.size(), 1u);
  EXPECT_EQ(dashed.problems[0].hint, "write --note=VALUE where the value begins with '-'");
}

TEST(ArgumentParser, missing_requirements_are_named) {
  SampleProgram sample;
  EXPECT_THAT(messages(sample.program.parse({"render"})),
              ElementsAre("argument GRAPH is missing", "option '--scene' is missing"));
  EXPECT_THAT(messages(sample.program.parse({"check"})), ElementsAre("argument GRAPH is missing"));
}

TEST(ArgumentParser, an_option_that_is_not_repeatable_is_given_once) {
  SampleProgram sample;
  EXPECT_THAT(messages(sample.program.parse({"render", "g", "--scene=s", "--seed=1", "--seed=2", "--seed=3"})),
              ElementsAre("option '--seed' was given more than once"));
}

TEST(ArgumentParser, unknown_and_missing_commands_suggest_others) {
  SampleProgram sample;
  const ParseResult typo = sample.program.parse({"rendr", "--anything", "g"});
  ASSERT_THAT(messages(typo), ElementsAre("there is no command 'rendr'"));
  EXPECT_EQ(typo.problems[0].hint, "did you mean 'render'?");
  const ParseResult other = sample.program.parse({"frobnicate"});
  EXPECT_EQ(other.problems.at(0).hint, "'lightloom --help' lists the commands");
  EXPECT_THAT(messages(sample.program.parse({})), ElementsAre("a command is missing"));
}

TEST(ArgumentParser, help_is_answered_everywhere_even_on_a_wrong_line) {
  SampleProgram sample;
  for (const auto& line : std::vector<std::vector<std::string>>{{"render", "--help"},
                                                                {"render", "-h"},
                                                                {"render", "--size", "x", "--help"},
                                                                {"render", "g", "--bad", "-h"}}) {
    const ParseResult result = sample.program.parse(line);
    EXPECT_EQ(result.kind, Kind::help);
    EXPECT_EQ(result.command->path(), "lightloom render");
  }
  EXPECT_EQ(sample.program.parse({"--help"}).command->path(), "lightloom");
  EXPECT_EQ(sample.program.parse({"help"}).kind, Kind::help);
  EXPECT_EQ(sample.program.parse({"help", "render"}).command->path(), "lightloom render");
  EXPECT_EQ(sample.program.parse({"check", "--", "--help"}).kind, Kind::run);
}

TEST(ArgumentParser, the_version_belongs_to_the_program) {
  SampleProgram sample;
  EXPECT_EQ(sample.program.parse({"--version"}).kind, Kind::version);
  EXPECT_EQ(sample.program.version_text(), "lightloom 1.2.3");
  EXPECT_EQ(sample.program.parse({"render", "g", "--scene=s", "--version"}).kind, Kind::problems);
}

TEST(ArgumentParser, an_existing_file_is_one_that_exists) {
  Command program("p", "P");
  std::filesystem::path file;
  program.option("--file", file, "A file").existing_file();
  EXPECT_EQ(program.parse({"--file", source_dir().string() + "/CMakeLists.txt"}).kind, Kind::run);
  EXPECT_THAT(messages(program.parse({"--file", "no/such"})),
              ElementsAre("option '--file': there is no file 'no/such'"));
  EXPECT_EQ(program.parse({"--file", source_dir().string()}).kind, Kind::problems);
}

TEST(ArgumentParser, contradicting_declarations_are_the_programmers_error) {
  Command program("p", "P");
  std::string text;
  std::vector<std::string> texts;
  program.option("-a,--alpha", text, "");
  EXPECT_THROW(program.option("--alpha", text, ""), std::logic_error);
  EXPECT_THROW(program.option("-a,--another", text, ""), std::logic_error);
  EXPECT_THROW(program.option("--help", text, ""), std::logic_error);
  EXPECT_THROW(program.option("alpha", text, ""), std::logic_error);
  EXPECT_THROW(program.option("-b", text, ""), std::logic_error);
  program.positional("MANY", texts, "");
  EXPECT_THROW(program.positional("AFTER", text, ""), std::logic_error);
  program.command("c", "");
  EXPECT_THROW(program.command("c", ""), std::logic_error);
}

// Any line of arguments must be answered: with a run, a help text, or problems that are not empty.
TEST(ArgumentParser, no_line_is_left_unanswered) {
  const std::vector<std::string> words = {"render",     "check", "help", "--",     "-",       "",    "--scene",
                                          "--size=1x1", "-n",    "-n=",  "-1",     "--count", "--=", "---",
                                          "=",          "--set", "a=b",  "--json", "-x",      "-nn", "--help"};
  size_t runs = 0;
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      for (const std::string& c : words) {
        SampleProgram sample;
        const ParseResult result = sample.program.parse({a, b, c});
        EXPECT_EQ(result.kind == Kind::problems, !result.problems.empty()) << a << " " << b << " " << c;
        ASSERT_NE(result.command, nullptr);
        if (result.kind == Kind::run) ++runs;
        for (const Problem& problem : result.problems) EXPECT_FALSE(problem.message.empty());
      }
    }
  }
  EXPECT_GT(runs, 0u);
}

}  // namespace
}  // namespace lightloom::cli
