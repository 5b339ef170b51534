#include <memory>
#include <ostream>

#include "framework/cli/commands.hpp"
#include "framework/cli/graph_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/scene_option.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/compile_graph.hpp"

namespace lightloom::cli {
namespace {

struct PlanOptions {
  std::filesystem::path graph;
  std::filesystem::path scene;
  GraphOptions changes;
};

ExitCode print(const PlanOptions& options, const CommandContext& context) {
  const std::optional<scene::Scene> scene = load_optional_scene(options.scene, context.err);
  Diagnostics diagnostics;
  const std::optional<Plan> plan = run::compile_graph(options.graph, context.registry, options.changes.link_options(),
                                                      scene ? &*scene : nullptr, diagnostics);
  print_diagnostics(context.err, diagnostics);
  if (!plan) return exit_code_of(diagnostics);
  context.out << print_plan(*plan);
  return ExitCode::done;
}

}  // namespace

void add_plan_command(Command& program, const CommandContext& context) {
  Command& command = program.command("plan", "Show what a frame of a graph executes, in order, and why");
  command.description(
      "Prints the passes in order, their parameters, what each reads and writes, the barriers with their reasons, the "
      "memory, and what was left out and why. Nothing is rendered.");
  auto options = std::make_shared<PlanOptions>();
  command.positional("GRAPH", options->graph, "Graph file (JSON)").required();
  command.option("--scene", options->scene, "Scene to plan for; a unit cube with every scene feature unless given");
  options->changes.add_to(command);
  command.action([options, &context] { return print(*options, context); });
}

}  // namespace lightloom::cli
