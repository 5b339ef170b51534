#include "framework/scene/json_scan.hpp"

#include <algorithm>

namespace lightloom::scene {
namespace {

constexpr uint64_t kObjectWeight = 4;  ///< values that an object counts as

/// Counts levels, values, and the elements of each array that is a member of the outermost object.
class Scanner {
 public:
  Scanner(const Limits& limits, const std::string& file) : limits_(limits), file_(file) {}

  void scan(std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '"') {
        const size_t end = end_of_string(text, i + 1);
        if (depth_ == 1) key_ = text.substr(i + 1, end - i - 1);
        empty_ = false;
        i = end;
      } else if (c == '{' || c == '[') {
        open(c);
      } else if (c == '}' || c == ']') {
        close(c);
      } else if (c == ',') {
        ++values_;
        if (in_array_ && depth_ == 2) ++elements_;
      } else if (c != ' ' && c != '\n' && c != '\t' && c != '\r') {
        empty_ = false;
      }
    }
    require_within(limits_, &Limits::json_values, file_ + ": the JSON", values_);
  }

 private:
  static size_t end_of_string(std::string_view text, size_t i) {
    while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
    return std::min(i, text.size());
  }

  void open(char c) {
    values_ += c == '{' ? kObjectWeight : 1;
    ++depth_;
    require_within(limits_, &Limits::json_depth, file_ + ": the JSON", depth_);
    if (depth_ == 2) {
      in_array_ = c == '[';
      elements_ = 0;
    }
    empty_ = true;
  }

  void close(char c) {
    if (depth_ == 2 && in_array_ && c == ']') {
      const uint64_t count = elements_ + (empty_ ? 0 : 1);
      const std::string name = file_ + ": " + std::string(key_.substr(0, kLongestKey));
      require_within(limits_, key_ == "nodes" ? &Limits::nodes : &Limits::elements, name, count);
      in_array_ = false;
    }
    empty_ = false;
    depth_ -= depth_ > 0 ? 1 : 0;
  }

  static constexpr size_t kLongestKey = 64;

  const Limits& limits_;
  const std::string& file_;
  uint64_t depth_ = 0;
  uint64_t values_ = 0;
  uint64_t elements_ = 0;  ///< commas of the array at depth 2
  bool in_array_ = false;
  bool empty_ = true;  ///< nothing but blanks since the last bracket was opened
  std::string_view key_;
};

}  // namespace

void require_json_within(std::string_view text, const Limits& limits, const std::string& file) {
  require_within(limits, &Limits::json_bytes, file + ": the JSON", text.size());
  Scanner(limits, file).scan(text);
}

}  // namespace lightloom::scene
