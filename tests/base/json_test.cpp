#include "framework/base/json.hpp"

#include <gtest/gtest.h>

#include <random>

namespace lightloom {
namespace {

JsonNode parse(const std::string& text) {
  Diagnostics diagnostics;
  std::optional<JsonNode> node = parse_json(text, "f", diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
  return node.value_or(JsonNode{});
}

Diagnostic only_problem(const std::string& text) {
  Diagnostics diagnostics;
  static_cast<void>(parse_json(text, "f", diagnostics));
  EXPECT_EQ(diagnostics.all().size(), 1U) << text;
  return diagnostics.all().empty() ? Diagnostic{} : diagnostics.all().front();
}

SourceLocation at(uint32_t line, std::size_t column) {
  return {"f", line, static_cast<uint32_t>(column)};
}

TEST(Json, PlacesOfEveryKind) {
  const JsonNode root = parse("[1, -2.5e3,\"s\", true ,false,null,[ ],{ }, 7]");
  ASSERT_EQ(root.elements.size(), 9U);
  const uint32_t columns[] = {2, 5, 12, 17, 23, 29, 34, 38, 43};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(root.elements[i].where, at(1, columns[i])) << i;
  EXPECT_EQ(root.where, at(1, 1));
}

TEST(Json, PlacesOfKeysAndNestedValues) {
  const JsonNode root = parse("{\n  \"a\": {\"b\" :3},\n\n\t\"c\"\n:\n [4]\n}");
  ASSERT_EQ(root.members.size(), 2U);
  EXPECT_EQ(root.members[0].where, at(2, 3));
  EXPECT_EQ(root.members[0].value.where, at(2, 8));
  EXPECT_EQ(root.members[0].value.members[0].where, at(2, 9));
  EXPECT_EQ(root.members[0].value.members[0].value.where, at(2, 14));
  EXPECT_EQ(root.members[1].where, at(4, 2));
  EXPECT_EQ(root.members[1].value.where, at(6, 2));
  EXPECT_EQ(root.members[1].value.elements[0].where, at(6, 3));
}

TEST(Json, LineEnds) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const JsonNode root = parse("[" + end + end + " 1," + end + "2]");
    EXPECT_EQ(root.elements[0].where, at(3, 2));
    EXPECT_EQ(root.elements[1].where, at(4, 1));
  }
}

TEST(Json, ColumnsCountCharacters) {
  // Two, three and four bytes in UTF-8; separators and escapes within strings.
  const JsonNode root = parse("[\"\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80\", 1, \"\\\"\\\\,:[\\u20ac\", 2]");
  EXPECT_EQ(root.elements[1].where, at(1, 9));
  EXPECT_EQ(root.elements[2].where, at(1, 12));
  EXPECT_EQ(root.elements[3].where, at(1, 29));
  EXPECT_EQ(root.elements[2].string, "\"\\,:[\xE2\x82\xAC");
}

TEST(Json, ByteOrderMarkCountsForNothing) {
  EXPECT_EQ(parse("\xEF\xBB\xBF[1]").elements[0].where, at(1, 2));
}

TEST(Json, ValuesAndKinds) {
  const JsonNode root = parse("[9223372036854775807, 9223372036854775808, -9223372036854775808, 1.0, 1e2, -0]");
  EXPECT_EQ(root.elements[0].kind, JsonKind::integer);
  EXPECT_EQ(root.elements[0].integer, INT64_MAX);
  EXPECT_EQ(root.elements[1].kind, JsonKind::real);
  EXPECT_EQ(root.elements[1].real, 9223372036854775808.0);
  EXPECT_EQ(root.elements[2].integer, INT64_MIN);
  EXPECT_EQ(root.elements[3].kind, JsonKind::real);
  EXPECT_EQ(root.elements[4].real, 100.0);
  EXPECT_EQ(root.elements[5].kind, JsonKind::integer);
}

TEST(Json, MembersKeepFileOrder) {
  const JsonNode root = parse(R"({"z": 1, "a": 2, "m": 3})");
  EXPECT_EQ(root.members[0].key, "z");
  EXPECT_EQ(root.members[2].key, "m");
  EXPECT_EQ(root.find("a")->integer, 2);
  EXPECT_EQ(root.find("b"), nullptr);
}

TEST(Json, DuplicateKeysAtTheSecondAndTheFirstStays) {
  Diagnostics diagnostics;
  const auto root = parse_json("{\"a\": 1,\n \"a\": {\"x\":1,\n\"x\":2}, \"b\": 5}", "f", diagnostics);
  const auto problems = diagnostics.sorted();
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].code, "duplicate-key");
  EXPECT_EQ(problems[0].where, at(2, 2));
  EXPECT_EQ(problems[1].where, at(3, 1));
  ASSERT_TRUE(root);
  EXPECT_EQ(root->members.size(), 2U);
  EXPECT_EQ(root->find("a")->integer, 1);
  EXPECT_EQ(root->find("b")->integer, 5);
}

TEST(Json, EqualKeysInDifferentObjectsAreFine) {
  parse(R"([{"a": 1}, {"a": {"a": 2}}])");
}

struct SyntaxCase {
  std::string text;
  uint32_t line;
  uint32_t column;
};

TEST(Json, SyntaxErrorsAtTheOffendingToken) {
  const SyntaxCase cases[] = {
      {"", 1, 1},
      {"  \n ", 2, 2},
      {"[1,,2]", 1, 4},
      {"[1,]", 1, 4},
      {"[1 2]", 1, 4},
      {"{\"a\" 1}", 1, 6},
      {"{\"a\"::1}", 1, 6},
      {"{a: 1}", 1, 2},
      {"{\"a\": 1,\n}", 2, 1},
      {"{\n  \"a\": tru\n}", 2, 8},
      {"{\n  \"a\": 01\n}", 2, 9},
      {"{\n  \"a\": 'x'\n}", 2, 8},
      {"[\"abc", 1, 2},
      {"[1, \"a\\q\"]", 1, 5},
      {"[1, 1e999]", 1, 5},
      {"{} x", 1, 4},
      {"[1", 1, 3},
      {"[1-2]", 1, 3},
      {"[1.5.5]", 1, 5},
      {"[-1e5e5]", 1, 6},
      {"{\"a\": [1, 2", 1, 12},
      {"[1] // comment", 1, 5},
      {"[NaN]", 1, 2},
      {"[\"\xff\"]", 1, 2},
  };
  for (const SyntaxCase& test : cases) {
    const Diagnostic problem = only_problem(test.text);
    EXPECT_EQ(problem.code, "json-syntax") << test.text;
    EXPECT_EQ(problem.where, at(test.line, test.column)) << test.text << "\n" << problem.message;
    EXPECT_FALSE(problem.message.empty());
    EXPECT_EQ(problem.message.find("json.exception"), std::string::npos) << problem.message;
  }
}

TEST(Json, DepthIsLimited) {
  const std::string deep(kJsonMaximumDepth, '[');
  parse(deep + std::string(kJsonMaximumDepth, ']'));
  const Diagnostic problem = only_problem(std::string(100000, '['));
  EXPECT_EQ(problem.code, "json-depth");
  EXPECT_EQ(problem.where, at(1, kJsonMaximumDepth + 1));
}

/// Writes a random tree with random white space and notes where each value begins.
class RandomText {
 public:
  explicit RandomText(uint32_t seed) : random_(seed) {}
  std::string text;
  std::vector<SourceLocation> places;

  void value(int depth) {
    space();
    places.push_back({"f", line_, column_});
    switch (random_() % (depth > 3 ? 5 : 7)) {
      case 0:
        return put("true");
      case 1:
        return put("null");
      case 2:
        return put(std::to_string(static_cast<int>(random_() % 2000) - 1000));
      case 3:
        return put("-1.25E+2");
      case 4:
        return put("\"\\\"a\xC3\xA9,]\"");
      case 5:
        return sequence('[', ']', depth, false);
      default:
        return sequence('{', '}', depth, true);
    }
  }
  void space() {
    for (auto n = random_() % 3; n > 0; --n) put(std::string(1, " \n\t"[random_() % 3]));
  }

 private:
  void put(const std::string& piece) {
    for (const char c : piece) {
      text += c;
      if (c == '\n') {
        ++line_;
        column_ = 1;
      } else if ((static_cast<unsigned char>(c) & 0xc0U) != 0x80U) {
        ++column_;
      }
    }
  }
  void sequence(char open, char close, int depth, bool keys) {
    put(std::string(1, open));
    const auto count = static_cast<uint32_t>(random_() % 4);
    for (uint32_t i = 0; i < count; ++i) {
      if (i > 0) put(",");
      space();
      if (keys) {
        put("\"k" + std::to_string(i) + "\"");
        space();
        put(":");
      }
      value(depth + 1);
    }
    space();
    put(std::string(1, close));
  }

  std::mt19937 random_;
  uint32_t line_ = 1;
  uint32_t column_ = 1;
};

void collect(const JsonNode& node, std::vector<SourceLocation>& places) {
  places.push_back(node.where);
  for (const JsonNode& element : node.elements) collect(element, places);
  for (const JsonMember& member : node.members) collect(member.value, places);
}

TEST(Json, PlacesOfRandomTrees) {
  std::size_t total = 0;
  for (uint32_t seed = 0; seed < 2000; ++seed) {
    RandomText random(seed);
    random.value(0);
    random.space();
    std::vector<SourceLocation> places;
    collect(parse(random.text), places);
    ASSERT_EQ(places, random.places) << random.text;
    total += places.size();
  }
  EXPECT_GT(total, 3000U);
}

}  // namespace
}  // namespace lightloom
