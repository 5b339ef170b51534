#include "framework/base/text.hpp"

#include <gtest/gtest.h>

#include <random>

namespace lightloom {
namespace {

/// The definition of a glob, by recursion.
bool matches_by_definition(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() == '*')
    return matches_by_definition(pattern.substr(1), text) ||
           (!text.empty() && matches_by_definition(pattern, text.substr(1)));
  return !text.empty() && (pattern.front() == '?' || pattern.front() == text.front()) &&
         matches_by_definition(pattern.substr(1), text.substr(1));
}

TEST(Glob, MatchesWholeText) {
  EXPECT_TRUE(glob_match("denoise_*", "denoise_box_x"));
  EXPECT_TRUE(glob_match("*.radiance", "trace.radiance"));
  EXPECT_TRUE(glob_match("*", ""));
  EXPECT_TRUE(glob_match("a?c", "abc"));
  EXPECT_FALSE(glob_match("a?c", "ac"));
  EXPECT_FALSE(glob_match("trace", "trace_surface"));
  EXPECT_FALSE(glob_match("", "a"));
}

TEST(Glob, AgreesWithItsDefinition) {
  std::mt19937 random(7);
  const auto word = [&](std::string_view letters) {
    std::string text(random() % 8, ' ');
    for (char& c : text) c = letters[random() % letters.size()];
    return text;
  };
  int matched = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string pattern = word("ab*?");
    const std::string text = word("ab");
    const bool expected = matches_by_definition(pattern, text);
    ASSERT_EQ(glob_match(pattern, text), expected) << pattern << " | " << text;
    matched += expected ? 1 : 0;
  }
  EXPECT_GT(matched, 1000);
}

TEST(Glob, ManyStarsTakeNoExponentialTime) {
  std::string pattern;
  for (int i = 0; i < 40; ++i) pattern += "a*";
  EXPECT_FALSE(glob_match(pattern + "b", std::string(4000, 'a')));
}

TEST(ClosestMatch, FindsTypingMistakes) {
  const std::vector<std::string> names{"gather", "voxelize", "trace", "tonemap"};
  EXPECT_EQ(closest_match("gahter", names), "gather");
  EXPECT_EQ(closest_match("voxelise", names), "voxelize");
  EXPECT_EQ(closest_match("Trace", names), "trace");
  EXPECT_EQ(closest_match("tonmap", names), "tonemap");
  EXPECT_EQ(closest_match("denoise", names), std::nullopt);
  EXPECT_EQ(closest_match("", names), std::nullopt);
  EXPECT_EQ(closest_match("x", {}), std::nullopt);
}

TEST(ClosestMatch, FirstOfEquals) {
  EXPECT_EQ(closest_match("ab", {"ac", "ad"}), "ac");
}

TEST(DidYouMean, FallsBackToTheList) {
  EXPECT_EQ(did_you_mean("trase", {"trace"}, "passes"), "did you mean 'trace'?");
  EXPECT_EQ(did_you_mean("xyzzy", {"trace", "merge"}, "passes"), "passes: trace, merge");
  EXPECT_EQ(did_you_mean("xyzzy", {"trace"}), "");
  EXPECT_EQ(did_you_mean("xyzzy", {}, "passes"), "");
}

TEST(Text, SplitAndJoinAreInverse) {
  for (const std::string text : {"", "a", "a.b", ".a.", "a..b"}) EXPECT_EQ(join(split(text, '.'), "."), text);
  EXPECT_EQ(split("", '.').size(), 1U);
}

TEST(Text, QuotesEscapeControlCharactersAndCutLongText) {
  EXPECT_EQ(in_quotes("a\nb"), "'a\\x0ab'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 100U);
}

TEST(SplitWords, KeepsQuotedBlanks) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(split_words(""), Words{});
  EXPECT_EQ(split_words("  a  b\t"), (Words{"a", "b"}));
  EXPECT_EQ(split_words(R"(graphs/a.json --set 'name=two words' --x "it's" '' p"q r"s)"),
            (Words{"graphs/a.json", "--set", "name=two words", "--x", "it's", "", "pq rs"}));
  EXPECT_EQ(split_words("'open quote"), Words{"open quote"});
}

}  // namespace
}  // namespace lightloom
