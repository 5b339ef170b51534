#include <memory>
#include <ostream>

#include "framework/cli/commands.hpp"
#include "framework/cli/pass_description.hpp"

namespace lightloom::cli {
namespace {

struct PassesOptions {
  std::string type;
  bool json = false;
  bool markdown = false;
};

void print_json(const PassesOptions& options, const CommandContext& context) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const std::string& name : context.registry.names()) {
    if (options.type.empty() || options.type == name) passes.push_back(pass_json(*context.registry.find(name)));
  }
  context.out << nlohmann::ordered_json{{"passes", passes}}.dump(2) << '\n';
}

ExitCode print(const PassesOptions& options, const CommandContext& context) {
  if (options.json) {
    print_json(options, context);
  } else if (options.markdown) {
    context.out << passes_markdown(context.registry);
  } else if (options.type.empty()) {
    context.out << list_passes(context.registry);
  } else {
    context.out << describe_pass(*context.registry.find(options.type));
  }
  return ExitCode::done;
}

}  // namespace

void add_passes_command(Command& program, const CommandContext& context) {
  Command& command = program.command("passes", "List the pass types, or show the ports and params of one");
  auto options = std::make_shared<PassesOptions>();
  command.positional("TYPE", options->type, "Pass type; all of them unless given").choices(context.registry.names());
  command.flag("--json", options->json, "Print JSON");
  command.flag("--markdown", options->markdown, "Print the page docs/passes.md, of all types");
  command.action([options, &context] { return print(*options, context); });
}

}  // namespace lightloom::cli
