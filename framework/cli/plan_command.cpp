#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "framework/base/atomic_file.hpp"
#include "framework/cli/cache_option.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/graph_options.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/scene_option.hpp"
#include "framework/gpu/memory.hpp"
#include "framework/graph/critical_path.hpp"
#include "framework/graph/plan.hpp"
#include "framework/graph/plan_dot.hpp"
#include "framework/graph/plan_json.hpp"
#include "framework/graph/verify.hpp"
#include "framework/page/make_plan_page.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/plugins.hpp"
#include "framework/run/run_times.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::cli {
namespace {

struct PlanOptions {
  std::filesystem::path graph;
  std::filesystem::path scene;
  LimitOptions limits;
  CacheOption cache;
  GraphOptions changes;
  std::string format = "text";
  std::filesystem::path out;
  std::filesystem::path times;
  std::string device;
  bool memory = false;
  bool verify = false;
};

/// What the device adds to a plan: who shares memory with whom.
PlanFacts::Memory plan_memory(const PlanOptions& options, Plan& plan) {
  const gpu::Device device({options.device, false});
  PlanFacts::Memory memory{run::memory_needs(device, plan.graph), {}};
  memory.sharing = run::share_on_device(device, plan, memory.needs);
  return memory;
}

PlanFacts::Times plan_times(const PlanOptions& options, const Plan& plan, std::ostream& err) {
  run::RunTimes times = run::read_run_times(options.times, plan);
  if (!times.same_plan)
    print_warning(err, "the run in '" + options.times.string() +
                           "' was of another plan (another size, parameter or option): its times may not fit this one");
  return {options.times.generic_string(), std::move(times.step_ms)};
}

std::string memory_text(const Plan& plan, const PlanFacts::Memory& planned) {
  std::ostringstream out;
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
  return out.str();
}

ExitCode print_verification(const Plan& plan, const PlanFacts::Memory& planned, std::ostream& out) {
  const Verification result = verify(plan, {&planned.sharing, planned.needs});
  out << "\nverified over " << result.frames << " frames: " << result.accesses << " accesses, " << result.barriers
      << " barriers, " << result.pairs << " pairs that must be ordered\n";
  for (const std::string& violation : result.violations) out << "  violation: " << violation << "\n";
  if (result.violations.empty()) out << "  no violation\n";
  return result.violations.empty() ? ExitCode::done : ExitCode::run_failed;
}

std::string written(const PlanOptions& options, const Plan& plan, const PlanFacts& facts) {
  if (options.format == "json") return plan_json(plan, facts).dump(2) + "\n";
  if (options.format == "dot") return plan_dot(plan);
  if (options.format == "html") return page::make_plan_page(plan, facts);
  std::string text = print_plan(plan);
  if (facts.memory && options.memory) text += memory_text(plan, *facts.memory);
  if (facts.times) text += print_critical_path(plan, facts.times->step_ms);
  return text;
}

ExitCode print(const PlanOptions& options, const CommandContext& context) {
  const std::optional<scene::Scene> scene =
      load_optional_scene(options.scene, options.limits.load_options(), context.err);
  Diagnostics diagnostics;
  std::optional<Plan> plan = run::compile_graph(
      options.graph, context.registry, options.changes.link_options(), scene ? &*scene : nullptr, diagnostics,
      options.changes.compile_options(), options.cache.apply_to(run::shader_folders_with(context.plugins)));
  print_diagnostics(context.err, diagnostics);
  if (!plan) return exit_code_of(diagnostics);
  PlanFacts facts;
  if (!options.times.empty()) facts.times = plan_times(options, *plan, context.err);
  if (options.memory || options.verify) facts.memory = plan_memory(options, *plan);
  const std::string text = written(options, *plan, facts);
  if (options.out.empty())
    context.out << text;
  else
    write_file_atomically(options.out, text);
  if (!options.verify) return ExitCode::done;
  const bool as_text = options.out.empty() && options.format == "text";
  return print_verification(*plan, *facts.memory, as_text ? context.out : context.err);
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
  command.option("--format", options->format, "Text; data; a drawing for Graphviz; a page to look at")
      .choices({"text", "json", "dot", "html"});
  command.option("--out", options->out, "Write it to a file").placeholder("FILE").completes(Completion::files);
  command
      .option("--times", options->times,
              "Run folder of the same graph: how its passes' times chain up, and what overlapping them could save")
      .placeholder("DIR")
      .completes(Completion::files);
  command.flag("--memory", options->memory,
               "Also where values that share memory lie, by the sizes that the device gives");
  command.flag(
      "--verify", options->verify,
      "Check the plan, with the memory that values share on the device, by a method of its own; exit code 1 if "
      "it is wrong");
  command.option("--device", options->device, "Device of --memory and --verify, by index or part of its name")
      .placeholder("NAME");
  options->limits.add_to(command);
  options->cache.add_to(command);
  command.action([options, &context] { return print(*options, context); });
}

}  // namespace lightloom::cli
