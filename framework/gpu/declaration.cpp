#include "framework/gpu/declaration.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace lightloom::gpu {
namespace {

struct Token {
  std::string_view text;
  uint32_t line = 0;
};

bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_word(std::string_view token) {
  return in_word(token.front()) && std::isdigit(static_cast<unsigned char>(token.front())) == 0;
}

/// Words, numbers and single characters, without comments and lines for the preprocessor.
class Tokenizer {
 public:
  explicit Tokenizer(std::string_view text) : text_(text) {}

  std::vector<Token> run() {
    while (at_ < text_.size()) step();
    return std::move(tokens_);
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '\n') {
      ++line_;
      ++at_;
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++at_;
    } else if (c == '#' || text_.substr(at_, 2) == "//") {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (text_.substr(at_, 2) == "/*") {
      const size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
      line_ += static_cast<uint32_t>(std::count(text_.begin() + at_, text_.begin() + end, '\n'));
      at_ = std::min(end + 2, text_.size());
    } else {
      size_t end = at_ + 1;
      while (in_word(c) && end < text_.size() && in_word(text_[end])) ++end;
      tokens_.push_back({text_.substr(at_, end - at_), line_});
      at_ = end;
    }
  }

  std::string_view text_;
  size_t at_ = 0;
  uint32_t line_ = 1;
  std::vector<Token> tokens_;
};

bool one_of(std::string_view token, std::string_view characters) {
  return token.size() == 1 && characters.find(token.front()) != std::string_view::npos;
}

}  // namespace

std::optional<uint32_t> declaration_line(std::string_view text, std::string_view name) {
  const std::vector<Token> tokens = Tokenizer(text).run();
  int depth = 0;
  bool interface_statement = false;  // since the last ';' or '}' outside of braces
  for (size_t i = 0; i < tokens.size(); ++i) {
    const std::string_view token = tokens[i].text;
    const bool follows_word = i > 0 && (is_word(tokens[i - 1].text) || tokens[i - 1].text == ",");
    const std::string_view next = i + 1 < tokens.size() ? tokens[i + 1].text : " ";
    if (token == name && follows_word && interface_statement && one_of(next, depth == 0 ? ";,[={" : ";,["))
      return tokens[i].line;
    if (token == "uniform" || token == "buffer" || token == "constant_id") interface_statement = true;
    if (token == "{") ++depth;
    if (token == "}") --depth;
    if (depth == 0 && (token == ";" || token == "}")) interface_statement = false;
  }
  return std::nullopt;
}

}  // namespace lightloom::gpu
