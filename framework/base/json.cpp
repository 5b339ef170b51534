#include "framework/base/json.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>

#include "framework/base/text.hpp"

namespace lightloom {
namespace {

/// Line and column of ascending offsets.
class LineCounter {
 public:
  explicit LineCounter(std::string_view text) : text_(text) {}

  void advance_to(std::size_t offset) {
    for (; offset_ < offset; ++offset_) {
      const char c = text_[offset_];
      const bool lone_return = c == '\r' && (offset_ + 1 == text_.size() || text_[offset_ + 1] != '\n');
      const bool continuation = (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
      if (c == '\n' || lone_return) {
        ++line_;
        column_ = 1;
      } else if (!continuation) {
        ++column_;
      }
    }
  }
  [[nodiscard]] uint32_t line() const { return line_; }
  [[nodiscard]] uint32_t column() const { return column_; }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  uint32_t line_ = 1;
  uint32_t column_ = 1;
};

std::string without_prefix(std::string message) {
  // "[json.exception.parse_error.101] parse error at line 1, column 4: syntax error while …"
  if (const auto bracket = message.find("] "); message.starts_with("[json") && bracket != std::string::npos)
    message.erase(0, bracket + 2);
  if (const auto colon = message.find(": "); message.starts_with("parse error at") && colon != std::string::npos)
    message.erase(0, colon + 2);
  // "…; last read: 'raw text'; expected …": the raw text runs back over the lines before.
  if (const auto raw = message.find("; last read: "); raw != std::string::npos) {
    const auto expected = message.rfind("; expected ");
    message.erase(raw, expected == std::string::npos || expected < raw ? std::string::npos : expected - raw);
  }
  return message;
}

/// Builds the tree from nlohmann's SAX events. The parser tells no positions, and has read one character too many
/// behind a number; but as it tells every token in order, each token's beginning is found by skipping what may stand
/// between it and the end of the one before.
class TreeBuilder {
 public:
  using number_integer_t = int64_t;
  using number_unsigned_t = uint64_t;
  using number_float_t = double;
  using string_t = std::string;
  using binary_t = nlohmann::json::binary_t;

  TreeBuilder(std::string_view text, const std::string& file, Diagnostics& diagnostics, uint64_t most_values)
      : text_(text), file_(file), diagnostics_(diagnostics), lines_(text), values_left_(most_values) {}

  JsonNode take_root() { return std::move(root_); }

  bool null() { return add(JsonKind::null, 4) != nullptr && count(); }
  bool boolean(bool value) {
    add(JsonKind::boolean, value ? 4 : 5)->boolean = value;
    return count();
  }
  bool number_integer(int64_t value) {
    JsonNode* node = add(JsonKind::integer, number_length());
    node->integer = value;
    node->real = static_cast<double>(value);
    return count();
  }
  bool number_unsigned(uint64_t value) {
    if (value <= static_cast<uint64_t>(std::numeric_limits<int64_t>::max()))
      return number_integer(static_cast<int64_t>(value));
    return number_float(static_cast<double>(value), {});
  }
  bool number_float(double value, const std::string& /*text*/) {
    add(JsonKind::real, number_length())->real = value;
    return count();
  }
  bool string(std::string& value) {
    add(JsonKind::string, string_length())->string = std::move(value);
    return count();
  }
  bool binary(binary_t& /*value*/) { return false; }
  bool start_object(std::size_t /*size*/) { return open(JsonKind::object); }
  bool start_array(std::size_t /*size*/) { return open(JsonKind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& value) {
    const SourceLocation where = begin_token(string_length());
    Level& level = levels_.back();
    level.duplicate = !level.keys.insert(value).second;
    if (level.duplicate)
      diagnostics_.error("duplicate-key", where, "key " + in_quotes(value) + " stands twice in this object");
    level.key = {value, where, {}};
    return true;
  }

  bool parse_error(std::size_t read, const std::string& /*token*/, const nlohmann::json::exception& exception) {
    skip_white_space();
    // A separator before the offending token; if the separator itself offends, the parser has read no further.
    while (cursor_ + 1 < read && cursor_ < text_.size() && (text_[cursor_] == ',' || text_[cursor_] == ':')) {
      ++cursor_;
      skip_white_space();
    }
    const bool at_end = cursor_ >= text_.size();
    diagnostics_.error(
        "json-syntax", here(),
        at_end ? "the file ends in the middle: " + without_prefix(exception.what()) : without_prefix(exception.what()));
    return false;
  }

 private:
  struct Level {
    JsonNode node;
    JsonMember key;
    std::unordered_set<std::string> keys;
    bool duplicate = false;
  };

  void skip_white_space() {
    while (cursor_ < text_.size() && std::string_view(" \t\r\n").find(text_[cursor_]) != std::string_view::npos)
      ++cursor_;
  }
  void skip_to_token() {
    skip_white_space();
    while (cursor_ < text_.size() && (text_[cursor_] == ',' || text_[cursor_] == ':')) {
      ++cursor_;
      skip_white_space();
    }
  }
  SourceLocation here() {
    lines_.advance_to(std::min(cursor_, text_.size()));
    return {file_, lines_.line(), lines_.column()};
  }
  SourceLocation begin_token(std::size_t length) {
    const SourceLocation where = here();
    cursor_ += length;
    return where;
  }
  /// By JSON's grammar: what follows a complete number at once, as in "01", is the next token.
  std::size_t number_length() {
    skip_to_token();
    std::size_t end = cursor_;
    const auto take = [&](std::string_view any_of) {
      const bool found = end < text_.size() && any_of.find(text_[end]) != std::string_view::npos;
      end += found ? 1 : 0;
      return found;
    };
    const auto take_digits = [&] {
      while (take("0123456789")) {
      }
    };
    take("-");
    if (!take("0")) take_digits();
    if (take(".")) take_digits();
    if (take("eE")) {
      take("+-");
      take_digits();
    }
    return end - cursor_;
  }
  std::size_t string_length() {
    skip_to_token();
    std::size_t end = cursor_ + 1;
    while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
    return end + 1 - cursor_;
  }

  JsonNode* place(JsonNode node) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return &root_;
    }
    Level& level = levels_.back();
    if (level.node.kind == JsonKind::array) return &level.node.elements.emplace_back(std::move(node));
    level.key.value = std::move(node);
    if (level.duplicate) return &level.key.value;
    return &level.node.members.emplace_back(std::move(level.key)).value;
  }
  JsonNode* add(JsonKind kind, std::size_t length) {
    skip_to_token();
    JsonNode node;
    node.kind = kind;
    node.where = begin_token(length);
    return place(std::move(node));
  }
  bool open(JsonKind kind) {
    skip_to_token();
    const SourceLocation where = begin_token(1);
    if (levels_.size() == kJsonMaximumDepth) {
      diagnostics_.error("json-depth", where,
                         "arrays and objects are nested deeper than " + std::to_string(kJsonMaximumDepth) + " levels");
      return false;
    }
    Level level;
    level.node.kind = kind;
    level.node.where = where;
    levels_.push_back(std::move(level));
    return count();
  }
  bool count() {
    if (values_left_ > 0) {
      --values_left_;
      return true;
    }
    diagnostics_.error("json-size", here(), "the file holds more values than are read");
    return false;
  }
  bool close() {
    skip_to_token();
    ++cursor_;
    JsonNode node = std::move(levels_.back().node);
    levels_.pop_back();
    place(std::move(node));
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  LineCounter lines_;
  uint64_t values_left_;
  std::size_t cursor_ = 0;  ///< behind the last token
  std::vector<Level> levels_;
  JsonNode root_;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
  const auto found =
      std::find_if(members.begin(), members.end(), [&](const JsonMember& member) { return member.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

std::string_view to_string(JsonKind kind) {
  switch (kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return "true or false";
    case JsonKind::integer:
      return "an integer";
    case JsonKind::real:
      return "a number";
    case JsonKind::string:
      return "a string";
    case JsonKind::array:
      return "an array";
    case JsonKind::object:
      break;
  }
  return "an object";
}

std::optional<JsonNode> parse_json(std::string_view text, const std::string& file_name, Diagnostics& diagnostics,
                                   uint64_t most_values) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  TreeBuilder builder(text, file_name, diagnostics, most_values);
  try {
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return std::nullopt;
  } catch (const nlohmann::json::exception& exception) {
    diagnostics.error("json-syntax", {file_name, 0, 0}, without_prefix(exception.what()));
    return std::nullopt;
  }
  return builder.take_root();
}

}  // namespace lightloom
