#include <memory>
#include <ostream>

#include "framework/cli/commands.hpp"

namespace lightloom::cli {

void add_completion_command(Command& program, const CommandContext& context) {
  Command& command = program.command("completion", "Print a completion script for the shell");
  command.description("Load it with: source <(lightloom completion bash)");
  auto shell = std::make_shared<std::string>();
  command.positional("SHELL", *shell, "Shell").choices({"bash"}).required();
  command.action([shell, &program, &context] {
    context.out << program.bash_completion();
    return ExitCode::done;
  });
}

}  // namespace lightloom::cli
