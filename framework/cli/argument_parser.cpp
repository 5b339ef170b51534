#include "framework/cli/argument_parser.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "framework/base/text.hpp"

namespace lightloom::cli {

Option& Option::required() {
  required_ = true;
  default_text_.clear();
  return *this;
}

Option& Option::group(std::string heading) {
  group_ = std::move(heading);
  return *this;
}

Option& Option::placeholder(std::string name) {
  placeholder_ = std::move(name);
  return *this;
}

Option& Option::range(double minimum, double maximum) {
  range_text_ = format_value(minimum) + " to " + format_value(maximum);
  return check([minimum, maximum, text = range_text_](std::string_view value) -> std::string {
    double number = 0;
    if (std::string problem = parse_value(value, number); !problem.empty()) return problem;
    if (number >= minimum && number <= maximum) return {};
    return "expected a value from " + text + ", got " + in_quotes(value);
  });
}

Option& Option::choices(std::vector<std::string> texts) {
  choices_ = std::move(texts);
  return *this;
}

Option& Option::existing_file() {
  return check([](std::string_view value) -> std::string {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(std::filesystem::path(value), ignored)) return {};
    return "there is no file " + in_quotes(value);
  });
}

Option& Option::check(Check check) {
  checks_.push_back(std::move(check));
  return *this;
}

Option& Option::default_text(std::string text) {
  default_text_ = std::move(text);
  return *this;
}

Option& Option::completes(Completion kind) {
  completion_ = kind;
  return *this;
}

std::string Option::subject() const {
  return is_positional() ? "argument " + placeholder_ : "option '" + long_name_ + "'";
}

Command::Command(std::string name, std::string summary) : name_(std::move(name)), summary_(std::move(summary)) {
  Option& help = add_option("-h,--help", "Show this help", {});
  help.takes_value_ = false;
}

Option& Command::flag(std::string_view names, bool& target, std::string doc) {
  Binding binding;
  binding.assign = [&target](std::string_view) {
    target = true;
    return std::string();
  };
  Option& option = add_option(names, std::move(doc), std::move(binding));
  option.takes_value_ = false;
  return option;
}

Command& Command::command(std::string name, std::string summary) {
  if (find_command(name) != nullptr) throw std::logic_error("command '" + name + "' is declared twice");
  commands_.push_back(std::make_unique<Command>(std::move(name), std::move(summary)));
  commands_.back()->parent_ = this;
  return *commands_.back();
}

Command& Command::description(std::string text) {
  description_ = std::move(text);
  return *this;
}

Command& Command::epilog(std::string text) {
  epilog_ = std::move(text);
  return *this;
}

Command& Command::version(std::string text) {
  version_ = std::move(text);
  Option& option = add_option("--version", "Show the version", {});
  option.takes_value_ = false;
  return *this;
}

Command& Command::action(std::function<ExitCode()> action) {
  action_ = std::move(action);
  return *this;
}

std::string Command::path() const {
  return parent_ == nullptr ? name_ : parent_->path() + " " + name_;
}

std::vector<const Command*> Command::commands() const {
  std::vector<const Command*> result;
  for (const auto& command : commands_) result.push_back(command.get());
  return result;
}

Option& Command::add_option(std::string_view names, std::string doc, Binding binding) {
  auto option = std::make_unique<Option>();
  for (const std::string& name : split(names, ',')) {
    const bool is_long = name.starts_with("--") && name.size() > 2;
    if (!is_long && !(name.size() == 2 && name[0] == '-' && name[1] != '-')) {
      throw std::logic_error("'" + name + "' is no option name");
    }
    if (find_option(name) != nullptr) throw std::logic_error("option '" + name + "' is declared twice");
    (is_long ? option->long_name_ : option->short_name_) = name;
  }
  if (option->long_name_.empty()) throw std::logic_error("option '" + std::string(names) + "' has no long name");
  option->doc_ = std::move(doc);
  option->assign_ = std::move(binding.assign);
  option->placeholder_ = std::move(binding.placeholder);
  option->default_text_ = std::move(binding.default_text);
  option->repeated_ = binding.repeated;
  option->completion_ = binding.completion;
  options_.push_back(std::move(option));
  return *options_.back();
}

Option& Command::add_positional(std::string name, std::string doc, Binding binding) {
  if (!positionals_.empty() && positionals_.back()->repeated_) {
    throw std::logic_error("no positional can follow a repeated one, and " + name + " does");
  }
  auto option = std::make_unique<Option>();
  option->placeholder_ = std::move(name);
  option->doc_ = std::move(doc);
  option->assign_ = std::move(binding.assign);
  option->default_text_ = std::move(binding.default_text);
  option->repeated_ = binding.repeated;
  option->completion_ = binding.completion;
  positionals_.push_back(std::move(option));
  return *positionals_.back();
}

const Option* Command::find_option(std::string_view name) const {
  const auto found = std::find_if(options_.begin(), options_.end(), [name](const auto& option) {
    return option->long_name_ == name || option->short_name_ == name;
  });
  return found == options_.end() ? nullptr : found->get();
}

const Command* Command::find_command(std::string_view name) const {
  const auto found =
      std::find_if(commands_.begin(), commands_.end(), [name](const auto& command) { return command->name_ == name; });
  return found == commands_.end() ? nullptr : found->get();
}

}  // namespace lightloom::cli
