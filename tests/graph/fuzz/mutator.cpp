#include "tests/graph/fuzz/mutator.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace lightloom::fuzz {
namespace {

using Tokens = std::vector<std::string>;

constexpr std::size_t kLongest = 200'000;  ///< of a text [bytes]

std::size_t string_end(const std::string& text, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

/// Strings, numbers and words, and all other characters one by one; put together again they give the text.
Tokens tokens_of(const std::string& text) {
  const auto in_word = [&](std::size_t i) {
    return std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.' || text[i] == '-' || text[i] == '+';
  };
  Tokens tokens;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin + 1;
    if (text[begin] == '"') {
      end = string_end(text, begin);
    } else if (in_word(begin)) {
      while (end < text.size() && in_word(end)) ++end;
    } else if (text[begin] == ' ' || text[begin] == '\n') {
      while (end < text.size() && (text[end] == ' ' || text[end] == '\n')) ++end;
    }
    tokens.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return tokens;
}

std::string text_of(const Tokens& tokens) {
  std::string text;
  for (const std::string& token : tokens) text += token;
  return text;
}

struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// From `begin` to the end of the member's value, by the balance of brackets.
Span member_at(const Tokens& tokens, std::size_t begin) {
  int depth = 0;
  for (std::size_t i = begin; i < tokens.size(); ++i) {
    const std::string& token = tokens[i];
    if (depth == 0 && token == ",") return {begin, i};
    if (token == "{" || token == "[") ++depth;
    if (token != "}" && token != "]") continue;
    if (depth == 0) return {begin, i};
    --depth;
  }
  return {begin, tokens.size()};
}

/// With the comma behind it, or, where it is the last one, with that before it.
Span with_comma(const Tokens& tokens, Span span) {
  std::size_t behind = span.end;
  while (behind < tokens.size() && tokens[behind].find_first_not_of(" \n") == std::string::npos) ++behind;
  if (behind < tokens.size() && tokens[behind] == ",") return {span.begin, behind + 1};
  std::size_t before = span.begin;
  while (before > 0 && tokens[before - 1].find_first_not_of(" \n") == std::string::npos) --before;
  if (before > 0 && tokens[before - 1] == ",") return {before - 1, span.end};
  return span;
}

/// Tokens that fit.
template <class Fits>
std::vector<std::size_t> find_all(const Tokens& tokens, Fits fits) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (fits(i)) found.push_back(i);
  return found;
}

std::vector<std::size_t> strings_in(const Tokens& tokens) {
  return find_all(tokens, [&](std::size_t i) { return tokens[i].size() >= 2 && tokens[i].front() == '"'; });
}

std::vector<std::size_t> keys_in(const Tokens& tokens) {
  return find_all(
      tokens, [&](std::size_t i) { return tokens[i].front() == '"' && i + 1 < tokens.size() && tokens[i + 1] == ":"; });
}

Span any_span(const Tokens& tokens, Random& random) {
  const std::size_t begin = random() % tokens.size();
  return {begin, std::min(tokens.size(), begin + 1 + random() % 12)};
}

std::ptrdiff_t offset(std::size_t index) {
  return static_cast<std::ptrdiff_t>(index);
}

void insert(Tokens& tokens, std::size_t at, const Tokens& what) {
  tokens.insert(tokens.begin() + offset(at), what.begin(), what.end());
}

void erase(Tokens& tokens, const Span& span) {
  tokens.erase(tokens.begin() + offset(span.begin), tokens.begin() + offset(span.end));
}

Tokens copy(const Tokens& tokens, const Span& span) {
  return {tokens.begin() + offset(span.begin), tokens.begin() + offset(span.end)};
}

const std::vector<std::string>& numbers() {
  static const std::vector<std::string> list = {"0",
                                                "1",
                                                "-1",
                                                "2147483648",
                                                "4294967296",
                                                "9223372036854775807",
                                                "1e999",
                                                "-1e999",
                                                "-0.0",
                                                "9223372036854775808",
                                                "18446744073709551616",
                                                "-9223372036854775808",
                                                "1e-400",
                                                "0.5",
                                                "1e308",
                                                "16384",
                                                "16385",
                                                "true",
                                                "false",
                                                "null",
                                                "[]",
                                                "{}",
                                                "\"\"",
                                                "0.1e"};
  return list;
}

const std::vector<std::string>& tails() {
  static const std::vector<std::string> list = {"@1",    "@2",     "@15",     "@16",          "@0",
                                                "@1..4", "@1..15", "@4..1",   "@99999999999", ".",
                                                "*",     "?",      "\\u0000", "\\ud800",      "\xf0\x9f\x98\x80",
                                                "\xff",  "@"};
  return list;
}

const std::vector<Tokens>& members() {
  static const std::vector<Tokens> list = {
      {"\"enabled\"", ":", "false", ","},          {"\"enabled\"", ":", "true", ","},
      {"\"when\"", ":", "\"scene.dynamic\"", ","}, {"\"when\"", ":", "\"!scene.dynamic\"", ","},
      {"\"params\"", ":", "{", "}", ","},          {"\"in\"", ":", "{", "}", ","}};
  return list;
}

std::string nest(Random& random) {
  constexpr std::size_t kLevels[] = {2, 62, 63, 64, 65, 1000, 20000};
  const std::string opener = random() % 2 == 0 ? "[" : "{\"a\":";
  std::string text;
  for (std::size_t level = kLevels[random() % std::size(kLevels)]; level > 0; --level) text += opener;
  return text;
}

void spoil_bytes(std::string& text, Random& random) {
  for (uint64_t count = 1 + random() % 4; count > 0 && !text.empty(); --count) {
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ static_cast<char>(1U << random() % 8));
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(random() % 256));
        break;
      case 2:
        text.erase(at, 1 + random() % 8);
        break;
      default:
        text.resize(at);
    }
  }
}

}  // namespace

Mutator::Mutator(std::vector<std::string> corpus, std::vector<std::string> names) : names_(std::move(names)) {
  for (const std::string& text : corpus) corpus_.push_back(tokens_of(text));
}

std::string Mutator::mutate(const std::string& text, Random& random) const {
  Tokens tokens = tokens_of(text);
  const uint64_t most = 1 + random() % 5;
  for (uint64_t changes = 1 + random() % most; changes > 0; --changes)
    if (!tokens.empty()) change(tokens, random);
  std::string result = text_of(tokens);
  if (random() % 16 == 0) spoil_bytes(result, random);
  if (result.size() > kLongest) result.resize(kLongest);
  return result;
}

void Mutator::change(Tokens& tokens, Random& random) const {
  const uint64_t kind = random() % 32;
  if (kind < 14) return change_member(tokens, random);
  if (kind < 31) return change_string(tokens, random);
  break_syntax(tokens, random);
}

/// Takes members away, adds, copies and renames them, borrows them from other files.
void Mutator::change_member(Tokens& tokens, Random& random) const {
  const std::vector<std::size_t> keys = keys_in(tokens);
  if (keys.empty()) return break_syntax(tokens, random);
  const Span member = member_at(tokens, any(keys, random));
  switch (random() % 5) {
    case 0:
      return erase(tokens, with_comma(tokens, member));
    case 1: {
      Tokens again = copy(tokens, member);
      if (random() % 4 != 0) again.front().insert(again.front().size() - 1, std::to_string(random() % 10));
      again.emplace_back(",");
      return insert(tokens, member.begin, again);
    }
    case 2:
      tokens[any(keys, random)] = tokens[any(keys, random)];
      return;
    case 3: {
      const Tokens& other = any(corpus_, random);
      const std::vector<std::size_t> others = keys_in(other);
      if (others.empty()) return;
      Tokens borrowed = copy(other, member_at(other, any(others, random)));
      borrowed.emplace_back(",");
      return insert(tokens, member.begin, borrowed);
    }
    default: {
      const auto openings = find_all(tokens, [&](std::size_t i) { return tokens[i] == "{"; });
      if (!openings.empty()) insert(tokens, any(openings, random) + 1, any(members(), random));
    }
  }
}

/// Edges lead elsewhere, types and numbers become others.
void Mutator::change_string(Tokens& tokens, Random& random) const {
  const std::vector<std::size_t> strings = strings_in(tokens);
  const auto is_number = [&](std::size_t i) {
    return std::isdigit(static_cast<unsigned char>(tokens[i].front())) != 0;
  };
  const std::vector<std::size_t> scalars = find_all(tokens, is_number);
  if (strings.empty()) return break_syntax(tokens, random);
  std::string& text = tokens[any(strings, random)];
  switch (random() % 6) {
    case 0:
    case 1:
      text = tokens[any(strings, random)];
      return;
    case 2:
      text = "\"" + any(names_, random) + "\"";
      return;
    case 3:
      text.insert(text.size() - 1, any(tails(), random));
      return;
    case 4:
      text = any(numbers(), random);
      return;
    default:
      if (!scalars.empty()) tokens[any(scalars, random)] = any(numbers(), random);
  }
}

void Mutator::break_syntax(Tokens& tokens, Random& random) const {
  const Span span = any_span(tokens, random);
  switch (random() % 5) {
    case 0:
      return erase(tokens, span);
    case 1:
      return insert(tokens, random() % tokens.size(), copy(tokens, span));
    case 2:
      return std::swap(tokens[span.begin], tokens[random() % tokens.size()]);
    case 3:
      return insert(tokens, span.begin, {nest(random)});
    default: {
      const Tokens& other = any(corpus_, random);
      if (!other.empty()) insert(tokens, span.begin, copy(other, any_span(other, random)));
    }
  }
}

}  // namespace lightloom::fuzz
