#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/cli/argument_parser.hpp"
#include "framework/cli/text_layout.hpp"

namespace lightloom::cli {
namespace {

constexpr size_t kColumns = 100;
constexpr size_t kDocColumn = 30;

}  // namespace

/// Writes the help of one command.
class HelpWriter {
 public:
  explicit HelpWriter(const Command& command) : command_(command) {}

  std::string write() {
    text_ = wrap(command_.summary_, kColumns, 0) + "\n\n";
    if (!command_.description_.empty()) text_ += wrap(command_.description_, kColumns, 0) + "\n\n";
    text_ += wrap("Usage: " + command_.path() + usage(), kColumns, 7) + "\n";
    write_commands();
    write_positionals();
    for (const std::string& group : groups()) write_group(group);
    if (!command_.epilog_.empty()) text_ += "\n" + command_.epilog_ + "\n";
    return text_;
  }

 private:
  [[nodiscard]] std::string usage() const {
    if (!command_.commands_.empty()) return " COMMAND [OPTIONS] [ARGUMENTS]";
    std::string text = " [OPTIONS]";
    for (const auto& positional : command_.positionals_) {
      const std::string name = positional->placeholder_ + (positional->repeated_ ? "..." : "");
      text += positional->required_ ? " " + name : " [" + name + "]";
    }
    for (const auto& option : command_.options_) {
      if (option->required_) text += " " + option->long_name_ + " " + option->placeholder_;
    }
    return text;
  }

  void write_row(const std::string& left, const std::string& right) {
    text_ += "  " + left;
    const size_t used = 2 + display_width(left);
    if (used + 2 > kDocColumn) {
      text_ += "\n" + std::string(kDocColumn, ' ');
    } else {
      text_ += std::string(kDocColumn - used, ' ');
    }
    text_ += wrap(right, kColumns, kDocColumn, kDocColumn) + "\n";
  }

  void write_commands() {
    if (command_.commands_.empty()) return;
    text_ += "\nCommands:\n";
    for (const auto& command : command_.commands_) write_row(command->name_, command->summary_);
    text_ += "\n'" + command_.path() + " COMMAND --help' shows the options of a command.\n";
  }

  void write_positionals() {
    if (command_.positionals_.empty()) return;
    text_ += "\nArguments:\n";
    for (const auto& positional : command_.positionals_) {
      write_row(positional->placeholder_ + (positional->repeated_ ? "..." : ""), documentation(*positional));
    }
  }

  /// Headings in the order in which they were declared, "Options" (where --help stands) last.
  [[nodiscard]] std::vector<std::string> groups() const {
    std::vector<std::string> headings;
    for (const auto& option : command_.options_) {
      const bool known = std::find(headings.begin(), headings.end(), option->group_) != headings.end();
      if (!known && option->group_ != "Options") headings.push_back(option->group_);
    }
    headings.emplace_back("Options");
    return headings;
  }

  void write_group(const std::string& heading) {
    text_ += "\n" + heading + ":\n";
    for (const auto& option : command_.options_) {
      if (option->group_ == heading && option->long_name_ != "--help") write_option(*option);
    }
    if (heading == "Options") write_option(*command_.find_option("--help"));
  }

  void write_option(const Option& option) {
    std::string left = option.short_name_.empty() ? "    " : option.short_name_ + ", ";
    left += option.long_name_;
    if (option.takes_value_) left += " " + option.placeholder_;
    write_row(left, documentation(option));
  }

  static std::string documentation(const Option& option) {
    std::vector<std::string> notes;
    if (option.required_ && !option.is_positional()) notes.emplace_back("required");
    if (option.repeated_ && !option.is_positional()) notes.emplace_back("can be repeated");
    if (!option.choices_.empty()) notes.push_back("one of: " + join(option.choices_, ", "));
    if (!option.range_text_.empty()) notes.push_back(option.range_text_);
    if (!option.default_text_.empty()) notes.push_back("default: " + option.default_text_);
    return notes.empty() ? option.doc_ : option.doc_ + " [" + join(notes, "; ") + "]";
  }

  const Command& command_;
  std::string text_;
};

std::string Command::help() const {
  return HelpWriter(*this).write();
}

}  // namespace lightloom::cli
