#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/cli/argument_values.hpp"

namespace lightloom::cli {

/// What the shell offers for a value.
enum class Completion { nothing, files };

/// One declared option, flag or positional argument. Made by Command; the setters return the option, so that they can
/// be chained as in CLI11.
class Option {
 public:
  /// Returns what is wrong with the text of a value, or "".
  using Check = std::function<std::string(std::string_view)>;

  Option& required();
  /// Heading of the help under which the option stands; "Options" unless said otherwise.
  Option& group(std::string heading);
  /// Replaces the placeholder in help, e.g. "DIR".
  Option& placeholder(std::string name);
  /// Numbers: both ends inclusive. Shown in help.
  Option& range(double minimum, double maximum);
  /// The only texts that are accepted. Shown in help and completed by the shell.
  Option& choices(std::vector<std::string> texts);
  Option& existing_file();
  Option& check(Check check);
  /// Replaces the default that help shows; "" shows none.
  Option& default_text(std::string text);
  Option& completes(Completion kind);

 private:
  friend class Command;
  friend class ArgumentReader;
  friend class HelpWriter;
  friend class BashCompletionWriter;

  [[nodiscard]] bool is_positional() const { return long_name_.empty() && short_name_.empty(); }
  /// "option '--size'" or "argument GRAPH", to begin a message with.
  [[nodiscard]] std::string subject() const;

  std::string long_name_;   ///< with its dashes; empty for positionals
  std::string short_name_;  ///< "-o"; may be empty
  std::string placeholder_;
  std::string doc_;
  std::string group_ = "Options";
  std::string default_text_;
  std::string range_text_;
  std::vector<std::string> choices_;
  std::vector<Check> checks_;
  std::function<std::string(std::string_view)> assign_;  ///< stores a value; empty for --help and --version
  bool takes_value_ = true;
  bool repeated_ = false;
  bool required_ = false;
  Completion completion_ = Completion::nothing;
};

/// One thing that is wrong with a command line: a sentence without a final full stop, and what to do about it.
struct Problem {
  std::string message;
  std::string hint;
};

class Command;

/// What a command line asks for. With `problems` nothing must be run.
struct ParseResult {
  enum class Kind { run, help, version, problems };
  Kind kind = Kind::run;
  const Command* command = nullptr;  ///< the innermost command that was named
  std::vector<Problem> problems;     ///< all of them, in the order of the command line
};

/// A program or a subcommand: declared options, positional arguments and subcommands, each bound to a variable that
/// must outlive the command. `--help` and `-h` come by themselves.
///
///     Command program("lightloom", "Declarative render graphs");
///     Command& render = program.command("render", "Render frames");
///     render.positional("GRAPH", graph, "Graph file").required();
///     render.option("-n,--count", count, "How many").range(1, 16).group("Frames");
///     const ParseResult result = program.parse({"render", "paper.json", "--count=3"});
///
/// Values follow as `--opt value`, `--opt=value`, `-o value` or `-ovalue`; a value that begins with '-' and is no
/// number needs the '='. `--` ends the options. Declaring one name twice throws std::logic_error.
class Command {
 public:
  Command(std::string name, std::string summary);
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// `names`: "--size" or "-s,--size". A std::vector target makes the option repeatable; the target's present value is
  /// the default that help shows, none for std::optional.
  template <typename T>
  Option& option(std::string_view names, T& target, const std::string& doc) {
    return add_option(names, doc, describe(target));
  }
  Option& flag(std::string_view names, bool& target, std::string doc);
  /// Positionals are filled in the order of their declaration; only the last may be repeated (a vector).
  template <typename T>
  Option& positional(const std::string& name, T& target, const std::string& doc) {
    return add_positional(name, doc, describe(target));
  }
  Command& command(std::string name, std::string summary);
  /// Paragraphs between the summary and the usage line.
  Command& description(std::string text);
  /// Text at the end of the help, e.g. examples; lines are kept as they are.
  Command& epilog(std::string text);
  /// Adds `--version`, which prints `text`.
  Command& version(std::string text);
  Command& action(std::function<ExitCode()> action);

  /// Reads the arguments (without the program's name) and assigns the targets. Never throws for what a user can type.
  [[nodiscard]] ParseResult parse(const std::vector<std::string>& arguments) const;
  [[nodiscard]] ExitCode run() const { return action_(); }

  [[nodiscard]] std::string help() const;             ///< wrapped to 100 columns, with a final newline
  [[nodiscard]] std::string bash_completion() const;  ///< a script for `source`
  [[nodiscard]] std::string path() const;             ///< "lightloom render"
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& summary() const { return summary_; }
  [[nodiscard]] const std::string& version_text() const { return version_; }
  [[nodiscard]] std::vector<const Command*> commands() const;

 private:
  friend class ArgumentReader;
  friend class HelpWriter;
  friend class BashCompletionWriter;

  /// All of an option that depends on the type of its target.
  struct Binding {
    std::function<std::string(std::string_view)> assign;
    std::string placeholder;
    std::string default_text;
    bool repeated = false;
    Completion completion = Completion::nothing;
  };
  template <typename T>
  static Binding describe(T& target) {
    using Kind = ValueKind<T>;
    Binding binding;
    binding.assign = [&target](std::string_view text) { return parse_value(text, target); };
    binding.placeholder = value_placeholder<typename Kind::Element>();
    binding.repeated = Kind::kRepeated;
    if constexpr (!Kind::kOptional) binding.default_text = format_value(target);
    if constexpr (std::is_same_v<typename Kind::Element, std::filesystem::path>) binding.completion = Completion::files;
    return binding;
  }
  Option& add_option(std::string_view names, std::string doc, Binding binding);
  Option& add_positional(std::string name, std::string doc, Binding binding);
  [[nodiscard]] const Option* find_option(std::string_view name) const;
  [[nodiscard]] const Command* find_command(std::string_view name) const;

  std::string name_;
  std::string summary_;
  std::string description_;
  std::string epilog_;
  std::string version_;
  const Command* parent_ = nullptr;
  std::vector<std::unique_ptr<Option>> options_;
  std::vector<std::unique_ptr<Option>> positionals_;
  std::vector<std::unique_ptr<Command>> commands_;
  std::function<ExitCode()> action_;
};

}  // namespace lightloom::cli
