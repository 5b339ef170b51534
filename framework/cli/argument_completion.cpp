#include "framework/base/text.hpp"
#include "framework/cli/argument_parser.hpp"

namespace lightloom::cli {

/// Writes a bash script that completes commands, options, choices and file names. It holds all it needs, so that
/// completing never starts the program.
class BashCompletionWriter {
 public:
  explicit BashCompletionWriter(const Command& program) : program_(program) {}

  std::string write() {
    const std::string function = "_" + program_.name_;
    text_ = "# Completion of " + program_.name_ + " for bash. Load it with: source <(" + program_.name_ +
            " completion bash)\n" + function + "() {\n";
    text_ += R"(  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command= word
  # bash makes '=' a word of its own.
  if [[ $current == "=" ]]; then current=; elif [[ $previous == "=" ]]; then previous=${COMP_WORDS[COMP_CWORD-2]}; fi
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
)";
    text_ += "    case $word in " + join(command_names(), "|") + ") command=$word; break ;; esac\n  done\n";
    text_ += "  case \"$command $previous\" in\n";
    for (const auto& command : program_.commands_) write_values(*command);
    text_ += "  esac\n  case $command in\n";
    text_ += "    '') " + words(join(command_names(), " ") + " " + option_names(program_)) + " ;;\n";
    for (const auto& command : program_.commands_) write_command(*command);
    text_ += "  esac\n}\ncomplete -o filenames -F " + function + " " + program_.name_ + "\n";
    return text_;
  }

 private:
  [[nodiscard]] std::vector<std::string> command_names() const {
    std::vector<std::string> names;
    for (const auto& command : program_.commands_) names.push_back(command->name_);
    return names;
  }

  static std::string option_names(const Command& command) {
    std::vector<std::string> names;
    for (const auto& option : command.options_) names.push_back(option->long_name_);
    return join(names, " ");
  }

  static std::string words(const std::string& list) {
    return "mapfile -t COMPREPLY < <(compgen -W '" + list + "' -- \"$current\")";
  }

  static std::string values_of(const Option& option) {
    if (!option.choices_.empty()) return words(join(option.choices_, " "));
    if (option.completion_ == Completion::files) return "mapfile -t COMPREPLY < <(compgen -f -- \"$current\")";
    return ":";
  }

  void write_values(const Command& command) {
    for (const auto& option : command.options_) {
      if (!option->takes_value_) continue;
      std::string pattern = "'" + command.name_ + " " + option->long_name_ + "'";
      if (!option->short_name_.empty()) pattern += "|'" + command.name_ + " " + option->short_name_ + "'";
      text_ += "    " + pattern + ") " + values_of(*option) + "; return ;;\n";
    }
  }

  void write_command(const Command& command) {
    const std::string positional = command.positionals_.empty() ? ":" : values_of(*command.positionals_.front());
    text_ += "    " + command.name_ + ") if [[ $current == -* ]]; then " + words(option_names(command)) + "; else " +
             positional + "; fi ;;\n";
  }

  const Command& program_;
  std::string text_;
};

std::string Command::bash_completion() const {
  return BashCompletionWriter(*this).write();
}

}  // namespace lightloom::cli
