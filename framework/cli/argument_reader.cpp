#include <algorithm>
#include <cctype>
#include <map>

#include "framework/base/text.hpp"
#include "framework/cli/argument_parser.hpp"

namespace lightloom::cli {
namespace {

bool is_negative_number(std::string_view text) {
  if (text.size() < 2 || text[0] != '-') return false;
  const size_t digit = text[1] == '.' ? 2 : 1;
  return digit < text.size() && std::isdigit(static_cast<unsigned char>(text[digit])) != 0;
}

/// A lone "-" commonly stands for standard input or output, so it is a value.
bool looks_like_option(std::string_view text) {
  return text.size() > 1 && text[0] == '-' && !is_negative_number(text);
}

}  // namespace

/// Reads one command line from left to right.
class ArgumentReader {
 public:
  ArgumentReader(const Command& program, const std::vector<std::string>& arguments)
      : command_(&program), arguments_(arguments) {}

  ParseResult read() {
    while (next_ < arguments_.size() && !stopped_) {
      const std::string& argument = arguments_[next_++];
      if (!options_ended_ && argument == "--") {
        options_ended_ = true;
      } else if (!options_ended_ && looks_like_option(argument)) {
        read_option(argument);
      } else if (!command_->commands_.empty()) {
        read_command(argument);
      } else {
        read_positional(argument);
      }
    }
    return result();
  }

 private:
  ParseResult result() {
    // A request for help or the version is answered even where something else is wrong.
    if (wanted_ != ParseResult::Kind::run) return {wanted_, command_, {}};
    if (!stopped_) report_missing();
    const auto kind = problems_.empty() ? ParseResult::Kind::run : ParseResult::Kind::problems;
    return {kind, command_, std::move(problems_)};
  }

  void report(std::string message, std::string hint = {}) {
    problems_.push_back({std::move(message), std::move(hint)});
  }

  [[nodiscard]] std::string help_hint(const std::string& what) const {
    return "'" + command_->path() + " --help' lists " + what;
  }

  void read_command(const std::string& argument) {
    const Command* found = command_->find_command(argument);
    if (found != nullptr) {
      command_ = found;
      return;
    }
    if (argument == "help") {
      wanted_ = ParseResult::Kind::help;
      return;
    }
    std::vector<std::string> names;
    for (const auto& command : command_->commands_) names.push_back(command->name_);
    std::string hint = did_you_mean(argument, names);
    report("there is no command " + in_quotes(argument), hint.empty() ? help_hint("the commands") : hint);
    // What follows belongs to a command that is not known.
    stopped_ = true;
  }

  void read_option(const std::string& argument) {
    const size_t equals = argument.find('=');
    std::string name = argument.substr(0, equals);
    std::optional<std::string> value;
    if (equals != std::string::npos) value = argument.substr(equals + 1);
    const Option* option = command_->find_option(name);
    if (option == nullptr && argument.size() > 2 && argument[1] != '-') {
      option = command_->find_option(argument.substr(0, 2));
      if (option != nullptr && option->takes_value_) {
        name = argument.substr(0, 2);
        value = argument.substr(2);
      } else {
        option = nullptr;
      }
    }
    if (option == nullptr) {
      report_unknown_option(name, value.has_value());
    } else if (option->takes_value_) {
      read_value(*option, std::move(value));
    } else {
      read_flag(*option, value.has_value());
    }
  }

  void read_flag(const Option& option, bool has_value) {
    if (has_value) report(option.subject() + " takes no value");
    if (option.long_name_ == "--help") wanted_ = ParseResult::Kind::help;
    if (option.long_name_ == "--version" && wanted_ == ParseResult::Kind::run) wanted_ = ParseResult::Kind::version;
    if (option.assign_) (void)option.assign_({});
  }

  void read_value(const Option& option, std::optional<std::string> value) {
    if (!value) {
      const bool present = next_ < arguments_.size() && !looks_like_option(arguments_[next_]);
      if (!present) {
        const bool dashed = next_ < arguments_.size() && command_->find_option(arguments_[next_]) == nullptr &&
                            arguments_[next_] != "--";
        report(option.subject() + " needs a value (" + option.placeholder_ + ")",
               dashed ? "write " + option.long_name_ + "=VALUE where the value begins with '-'" : "");
        if (dashed && arguments_[next_].find('=') == std::string::npos) ++next_;
        seen_[&option] += 1;
        return;
      }
      value = arguments_[next_++];
    }
    if (++seen_[&option] == 2 && !option.repeated_) report(option.subject() + " was given more than once");
    assign(option, *value);
  }

  void read_positional(const std::string& argument) {
    if (position_ >= command_->positionals_.size()) {
      report("unexpected argument " + in_quotes(argument), "usage: " + usage_of_positionals());
      return;
    }
    const Option& option = *command_->positionals_[position_];
    seen_[&option] += 1;
    if (!option.repeated_) ++position_;
    assign(option, argument);
  }

  [[nodiscard]] std::string usage_of_positionals() const {
    std::string usage = command_->path() + " [OPTIONS]";
    for (const auto& positional : command_->positionals_) usage += " " + positional->placeholder_;
    return usage;
  }

  void assign(const Option& option, const std::string& text) {
    std::string problem = option.assign_(text);
    const auto& choices = option.choices_;
    if (problem.empty() && !choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end()) {
      report(option.subject() + ": " + in_quotes(text) + " is not one of its choices",
             did_you_mean(text, choices, "choose one of"));
      return;
    }
    for (const auto& check : option.checks_) {
      if (problem.empty()) problem = check(text);
    }
    if (!problem.empty()) report(option.subject() + ": " + problem);
  }

  void report_unknown_option(const std::string& name, bool has_value) {
    std::vector<std::string> names;
    for (const auto& option : command_->options_) names.push_back(option->long_name_);
    const std::optional<std::string> closest = closest_match(name, names);
    report(in_quotes(command_->path()) + " has no option " + in_quotes(name),
           closest ? "did you mean '" + *closest + "'?" : help_hint("the options"));
    // Its value must not be taken for a positional, which would only add a misleading second message.
    if (has_value || next_ >= arguments_.size() || looks_like_option(arguments_[next_])) return;
    const bool meant_a_value = closest && command_->find_option(*closest)->takes_value_;
    const bool no_place = command_->commands_.empty() && position_ >= command_->positionals_.size();
    if (meant_a_value || (!closest && no_place)) ++next_;
    if (closest) seen_[command_->find_option(*closest)] += 1;
  }

  void report_missing() {
    if (!command_->commands_.empty()) {
      report("a command is missing", help_hint("the commands"));
      return;
    }
    for (const auto* declared : {&command_->positionals_, &command_->options_}) {
      for (const auto& option : *declared) {
        if (!option->required_ || seen_[option.get()] > 0) continue;
        report(option->subject() + " is missing", option->doc_);
      }
    }
  }

  const Command* command_;
  const std::vector<std::string>& arguments_;
  size_t next_ = 0;
  size_t position_ = 0;
  bool options_ended_ = false;
  bool stopped_ = false;
  ParseResult::Kind wanted_ = ParseResult::Kind::run;
  std::map<const Option*, int> seen_;
  std::vector<Problem> problems_;
};

ParseResult Command::parse(const std::vector<std::string>& arguments) const {
  return ArgumentReader(*this, arguments).read();
}

}  // namespace lightloom::cli
