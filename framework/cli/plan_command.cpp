#include <memory>
#include <ostream>

#include "framework/cli/commands.hpp"
#include "framework/cli/graph_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/scene_option.hpp"
#include "framework/gpu/memory.hpp"
#include "framework/graph/plan.hpp"
#include "framework/graph/share_memory.hpp"
#include "framework/graph/verify.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::cli {
namespace {

struct PlanOptions {
  std::filesystem::path graph;
  std::filesystem::path scene;
  GraphOptions changes;
  std::string device;
  bool memory = false;
  bool verify = false;
};

/// What the device adds to a plan: who shares memory with whom.
struct PlannedSharing {
  std::vector<MemoryNeed> needs;
  MemorySharing sharing;
};

PlannedSharing plan_sharing(const PlanOptions& options, Plan& plan) {
  const gpu::Device device({options.device, false});
  PlannedSharing planned{run::memory_needs(device, plan.graph), {}};
  planned.sharing = run::share_on_device(device, plan, planned.needs);
  return planned;
}

void print_memory(const Plan& plan, const PlannedSharing& planned, std::ostream& out) {
  out << "\nmemory that values share\n";
  for (size_t heap = 0; heap < planned.sharing.heaps.size(); ++heap) {
    const SharedHeap& shared = planned.sharing.heaps[heap];
    out << "  heap " << heap << ": " << gpu::bytes_text(shared.bytes) << "; no sharing needs less than "
        << gpu::bytes_text(shared.lower_bound) << "; apart its values would need " << gpu::bytes_text(shared.unshared)
        << "\n";
    for (ValueId value = 0; value < plan.graph.values.size(); ++value) {
      const std::optional<SharedPlace>& place = planned.sharing.places[value];
      if (place && place->heap == heap)
        out << "    " << place->offset << " to " << place->offset + planned.needs[value].size << ": "
            << value_name(plan.graph.values[value]) << "\n";
    }
  }
}

ExitCode print_verification(const Plan& plan, const PlannedSharing& planned, std::ostream& out) {
  const Verification result = verify(plan, {&planned.sharing, planned.needs});
  out << "\nverified over " << result.frames << " frames: " << result.accesses << " accesses, " << result.barriers
      << " barriers, " << result.pairs << " pairs that must be ordered\n";
  for (const std::string& violation : result.violations) out << "  violation: " << violation << "\n";
  if (result.violations.empty()) out << "  no violation\n";
  return result.violations.empty() ? ExitCode::done : ExitCode::run_failed;
}

ExitCode print(const PlanOptions& options, const CommandContext& context) {
  const std::optional<scene::Scene> scene = load_optional_scene(options.scene, context.err);
  Diagnostics diagnostics;
  std::optional<Plan> plan =
      run::compile_graph(options.graph, context.registry, options.changes.link_options(), scene ? &*scene : nullptr,
                         diagnostics, options.changes.compile_options());
  print_diagnostics(context.err, diagnostics);
  if (!plan) return exit_code_of(diagnostics);
  if (!options.memory && !options.verify) {
    context.out << print_plan(*plan);
    return ExitCode::done;
  }
  const PlannedSharing planned = plan_sharing(options, *plan);
  context.out << print_plan(*plan);
  if (options.memory) print_memory(*plan, planned, context.out);
  return options.verify ? print_verification(*plan, planned, context.out) : ExitCode::done;
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
  command.flag("--memory", options->memory,
               "Also where values that share memory lie, by the sizes that the device gives");
  command.flag(
      "--verify", options->verify,
      "Check the plan, with the memory that values share on the device, by a method of its own; exit code 1 if "
      "it is wrong");
  command.option("--device", options->device, "Device of --memory and --verify, by index or part of its name")
      .placeholder("NAME");
  command.action([options, &context] { return print(*options, context); });
}

}  // namespace lightloom::cli
