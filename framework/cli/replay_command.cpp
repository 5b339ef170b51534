#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>

#include "framework/base/interrupt.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/cache_option.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/graph_options.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/picture_options.hpp"
#include "framework/run/replay.hpp"

namespace lightloom::cli {
namespace {

struct ReplayOptions {
  std::filesystem::path folder;
  std::vector<std::string> passes;
  std::optional<uint32_t> frame;
  std::filesystem::path graph;
  std::filesystem::path scene;
  LimitOptions limits;
  std::vector<Assignment> sets;
  std::vector<Assignment> swaps;
  std::vector<std::filesystem::path> shaders;
  CacheOption cache;
  bool compare = false;
  uint32_t repeat = 1;
  std::filesystem::path out;
  std::string device;
  bool validate = false;
};

run::ReplayRequest make_request(const ReplayOptions& options, const CommandContext& context,
                                const std::vector<std::string>& arguments) {
  run::ReplayRequest request;
  request.folder = options.folder;
  request.passes = options.passes;
  request.frame = options.frame;
  request.graph = options.graph;
  request.scene = options.scene;
  request.load = options.limits.load_options();
  for (const Assignment& set : options.sets) request.sets.emplace_back(set.name, set.value);
  for (const Assignment& swap : options.swaps) request.swaps.emplace_back(swap.name, swap.value);
  request.compile = GraphOptions().compile_options();
  request.compare = options.compare;
  request.repeat = options.repeat;
  request.out = options.out;
  request.device = {options.device, options.validate};
  request.shaders = options.cache.apply_to(run::shader_folders_with(context.plugins));
  request.shaders.sources.insert(request.shaders.sources.begin(), options.shaders.begin(), options.shaders.end());
  request.plugins = context.plugins;
  request.command_line = {"lightloom"};
  request.command_line.insert(request.command_line.end(), arguments.begin(), arguments.end());
  return request;
}

std::string place_text(const run::ReplayedValue& value) {
  const auto& [x, y, z] = value.difference->place;
  std::string text = "(" + std::to_string(x) + ", " + std::to_string(y);
  if (z > 0) text += ", " + std::to_string(z);
  return text + ") " + value.channels.at(value.difference->channel);
}

std::string verdict(const run::ReplayedValue& value) {
  if (!value.dumped) return "was not dumped";
  if (!value.difference) return "";
  const image::BitDifference& difference = *value.difference;
  if (difference.texels == 0) return "equals the dump bit for bit";
  std::ostringstream text;
  text << std::setprecision(9) << difference.texels << " of " << value.texels << " texels differ, most at "
       << place_text(value) << ": " << difference.one << ", in the dump " << difference.other;
  return text.str();
}

std::string milliseconds_text(double milliseconds) {
  if (milliseconds < 0) return "time unknown";
  std::ostringstream text;
  text << std::setprecision(milliseconds >= 100 ? 6 : 3) << milliseconds << " ms";
  return text.str();
}

void print(const run::ReplaySummary& summary, uint32_t repeat, std::ostream& out) {
  out << "frame " << summary.frame << (repeat > 1 ? ", median of " + std::to_string(repeat) + " runs" : "") << "\n";
  for (const run::PassTime& time : summary.times) {
    out << "  " << time.pass << "  " << milliseconds_text(time.milliseconds) << "\n";
    for (const run::ReplayedValue& value : summary.values)
      if (value.name.starts_with(time.pass + "."))
        out << "    " << value.name << (verdict(value).empty() ? "" : "  ") << verdict(value) << "\n";
  }
  if (!summary.compared)
    out << "not held against the dumps, as this has changed (--compare does it all the same): "
        << join(summary.changes, "; ") << "\n";
  else if (!summary.changes.empty())
    out << "changed since the run: " << join(summary.changes, "; ") << "\n";
  out << "written to " << summary.folder.string() << "\n";
}

ExitCode replay(const ReplayOptions& options, const CommandContext& context,
                const std::vector<std::string>& arguments) {
  const InterruptRequests interrupts;
  Diagnostics diagnostics;
  run::ReplaySummary summary;
  const bool done = run::replay(make_request(options, context, arguments), context.registry, diagnostics, summary);
  print_diagnostics(context.err, diagnostics);
  if (!done) return exit_code_of(diagnostics);
  for (const std::string& warning : summary.warnings) print_warning(context.err, warning);
  for (const std::string& note : summary.notes) context.err << "note: " << note << "\n";
  print(summary, options.repeat, context.out);
  if (summary.same || !summary.changes.empty()) return ExitCode::done;
  print_error(context.err, "what was replayed differs from what was dumped, although nothing is known to have changed",
              "a pass type that was compiled anew is not known");
  return ExitCode::run_failed;
}

}  // namespace

void add_replay_command(Command& program, const CommandContext& context, const std::vector<std::string>& arguments) {
  Command& command = program.command("replay", "Run passes of a rendered frame again, from the dumps of their inputs");
  command.description(
      "Takes the scene, the camera, the seed, the graph and all options from the run folder, and what the passes read "
      "from its dumps (render ... --dump '*'), so that neither another pass nor an earlier frame runs. Says of each "
      "output whether it has the bits of its dump, and how long the passes took. Exit code 1 if bits differ although "
      "nothing has been changed.");
  auto options = std::make_shared<ReplayOptions>();
  command.positional("DIR", options->folder, "Run folder with dumps").required();
  command.positional("PASS", options->passes, "Passes, by name or pattern such as 'denoise_*'").required();
  command.option("--frame", options->frame, "Frame of the run; the last dumped one unless given").default_text("");
  command.option("--repeat", options->repeat, "Run the passes so many times, and tell the median of their times")
      .range(1, 100'000);
  command.option("-o,--out", options->out, "Run folder of what the passes write, made if missing")
      .placeholder("DIR")
      .default_text("the folder 'replay' in the run folder");
  command.flag("--compare", options->compare,
               "Hold the outputs against the dumps even where something has changed, and say how they differ");
  command.option("--scene", options->scene, "Where the scene is now, if it has moved");
  const auto changes = [](Option& option) -> Option& { return option.group("Changes to the graph"); };
  changes(command.option("--graph", options->graph, "An edited graph file instead of the graph as it was recorded"));
  changes(
      command.option("--set", options->sets,
                     "Set a parameter of the graph (NAME=VALUE) or of a pass (PASS.PARAM=VALUE, where PASS may be a "
                     "pattern)"));
  changes(command.option("--swap", options->swaps, "Exchange the type of the passes that match"))
      .placeholder("GLOB=TYPE");
  options->limits.add_to(command);
  add_shaders_option(command, options->shaders);
  options->cache.add_to(command);
  command.option("--device", options->device, "Device by index or part of its name; 'lightloom devices' lists them")
      .placeholder("NAME");
  command.flag("--validate", options->validate, "Check each Vulkan call by the validation layers (slow)");
  command.action([options, &context, arguments] { return replay(*options, context, arguments); });
}

}  // namespace lightloom::cli
