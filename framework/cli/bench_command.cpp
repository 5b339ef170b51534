#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <utility>

#include "framework/base/interrupt.hpp"
#include "framework/base/process.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/bench_report.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/picture_options.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/study/bench.hpp"

namespace lightloom::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct BenchOptions {
  PictureOptions picture;
  uint32_t warm_up = 10;
  std::string against;
  std::string device;
  bool no_alias = false;
  bool count_rays = false;
  bool floors = false;
  bool json = false;
};

/// What differs between the two runs of a comparison.
struct Contender {
  std::filesystem::path graph;
  GraphOptions changes;
  bool no_alias = false;
  std::string name;
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// What `--against` says, with the options of `bench` that change the graph; its graph is that of the first run unless
/// it names one.
Contender parse_contender(const std::string& text, const std::filesystem::path& first_graph) {
  Contender contender{first_graph, {}, false, text};
  Command words("--against", "");
  words.positional("GRAPH", contender.graph, "Graph file");
  contender.changes.add_to(words);
  words.flag("--no-alias", contender.no_alias, "");
  const ParseResult result = words.parse(split_words(text));
  if (result.kind == ParseResult::Kind::run) return contender;
  const Problem problem = result.problems.empty() ? Problem{"asks for help", ""} : result.problems.front();
  throw Error(ExitCode::usage, "option '--against': " + problem.message,
              problem.hint.empty() ? "it takes a graph file and options that change graphs, in quotes: "
                                     "--against \"graphs/lightloom.json --set paths=4\""
                                   : problem.hint);
}

/// Empty where the graph has problems, which are then in `diagnostics`.
std::optional<study::BenchRun> make_run(const BenchOptions& options, const Contender& contender,
                                        const scene::Scene& scene, const CommandContext& context,
                                        Diagnostics& diagnostics) {
  const Clock::time_point start = Clock::now();
  const run::RenderRequest request = options.picture.request(context);
  LinkOptions link = contender.changes.link_options();
  std::optional<Plan> plan = run::compile_graph(contender.graph, context.registry, link, &scene, diagnostics,
                                                contender.changes.compile_options(), request.shaders);
  if (!plan) return std::nullopt;
  study::BenchRun run{contender.name, std::move(*plan), milliseconds_since(start), {}};
  run.options.shaders = request.shaders;
  run.options.camera = request.camera;
  if (!request.camera_path.empty()) run.options.camera_path = scene::read_camera_path(request.camera_path);
  run.options.seed = request.seed;
  run.options.frames_per_second = request.frames_per_second;
  run.options.frozen_time = request.frozen_time;
  run.options.share_memory = !contender.no_alias;
  return run;
}

/// A frame of its own: reading the counts would cost time in those that are measured.
std::optional<study::RayCounts> count_rays(const BenchOptions& options, const Contender& contender,
                                           const scene::Scene& scene, gpu::Device& device, const study::BenchRun& run,
                                           const CommandContext& context) {
  const std::vector<GraphPass>& passes = run.plan.graph.passes;
  const bool any = std::any_of(passes.begin(), passes.end(), [](const GraphPass& pass) {
    return pass.type->find_port("counts", Direction::out) != nullptr;
  });
  if (!any) {
    if (!options.count_rays) return std::nullopt;
    print_warning(context.err, "no pass of '" + contender.name + "' counts its rays; voxel_path_trace does");
    return std::nullopt;
  }
  LinkOptions link = contender.changes.link_options();
  link.captures = {"*.counts"};
  Diagnostics ignored;  // said already, of the same graph
  std::optional<Plan> plan = run::compile_graph(contender.graph, context.registry, link, &scene, ignored,
                                                contender.changes.compile_options(), run.options.shaders);
  run::Executor executor(device, std::move(*plan), scene, run.options);
  return study::count_rays(executor.run_frame(options.picture.frames.first + options.warm_up));
}

study::BenchMemory memory_held(const gpu::Device& device) {
  return {.host = memory_bytes(),
          .host_peak = peak_memory_bytes(),
          .device_peak = device.memory_ledger().peaks(),
          .device_peak_total = device.memory_ledger().peak()};
}

/// Needs the rays.
void add_floors(study::BenchRecord& record, gpu::Device& device, const run::ShaderFolders& shaders) {
  std::set<Format> formats;
  for (const Plan& plan : record.plans) formats.merge(study::formats_of(plan));
  const std::shared_ptr<run::ShaderLibrary> library = run::make_library(device, shaders);
  record.rates = study::measure_rates(device, *library, record.plans.front().graph.trace, formats);
  for (size_t i = 0; i < record.runs.size(); ++i)
    record.floors.push_back(study::floors_of(record.plans[i], record.runs[i], *record.rates));
}

ExitCode bench(const BenchOptions& options, const CommandContext& context, const std::vector<std::string>& arguments) {
  const InterruptRequests interrupts;
  study::BenchRecord record;
  record.command_line = {"lightloom"};
  record.command_line.insert(record.command_line.end(), arguments.begin(), arguments.end());
  Clock::time_point start = Clock::now();
  const scene::Scene scene = scene::load_scene(options.picture.scene, options.picture.limits.load_options());
  record.scene_ms = milliseconds_since(start);
  start = Clock::now();
  gpu::Device device({options.device, false});
  record.device_ms = milliseconds_since(start);

  std::vector<Contender> contenders = {
      {options.picture.graph, options.picture.changes, options.no_alias, options.picture.graph.generic_string()}};
  if (!options.against.empty()) contenders.push_back(parse_contender(options.against, options.picture.graph));
  std::vector<study::BenchRun> runs;
  Diagnostics diagnostics;
  for (const Contender& contender : contenders)
    if (auto run = make_run(options, contender, scene, context, diagnostics)) runs.push_back(std::move(*run));
  print_diagnostics(context.err, diagnostics);
  if (runs.size() < contenders.size()) return exit_code_of(diagnostics);

  record.settings = {options.picture.frames.first, options.picture.frames.last - options.picture.frames.first + 1,
                     options.warm_up};
  {
    ProgressBar bar(context.err, context.err_is_terminal, "bench", "frames",
                    record.settings.frames + record.settings.warm_up);
    record.runs = study::measure(device, scene, runs, record.settings, [&](uint32_t done, uint32_t total) {
      bar.update(done);
      if (done == total) record.memory = memory_held(device);
    });
  }
  for (size_t i = 0; i < runs.size(); ++i) {
    if (options.count_rays || options.floors)
      record.runs[i].rays = count_rays(options, contenders[i], scene, device, runs[i], context);
    record.plans.push_back(std::move(runs[i].plan));
  }
  record.device = device.info();
  if (options.floors) add_floors(record, device, options.picture.request(context).shaders);
  if (options.json)
    context.out << study::bench_json(record, scene).dump(2) << '\n';
  else
    context.out << bench_report(record);
  return ExitCode::done;
}

}  // namespace

void add_bench_command(Command& program, const CommandContext& context, const std::vector<std::string>& arguments) {
  Command& command = program.command("bench", "Measure what the frames of a graph cost, alone or against another");
  command.description(
      "Runs frames, the first ones to warm up, and prints what is spent once and what in every frame: the whole frame "
      "running freely, and each pass timed alone in frames of its own; median and 95th percentile. With --against, two "
      "graphs run frame by frame in turn, and each ratio comes with an interval of 95 % that says whether it is more "
      "than the noise of the machine.");
  auto options = std::make_shared<BenchOptions>();
  options->picture.frames = {0, 19};
  options->picture.add_graph_to(command);
  options->picture.add_to(command);
  command.option("--warm-up", options->warm_up, "Frames before the measured ones, which fill histories and caches")
      .placeholder("FRAMES")
      .range(1, kLastFrame);
  command
      .option("--against", options->against,
              "A second run in the same call: a graph, options that change graphs, or both, in quotes")
      .placeholder("\"[GRAPH] [OPTIONS]\"");
  command.flag("--count-rays", options->count_rays,
               "Also count the rays and steps of a frame, where a pass can, in a frame that is not measured");
  command.flag("--floors", options->floors,
               "Also measure what the device does at best, and set each pass beside the least time that its bytes, "
               "texels and steps take at these rates");
  command.flag("--no-alias", options->no_alias, "Give every value memory of its own");
  command.option("--device", options->device, "Device by index or part of its name; 'lightloom devices' lists them")
      .placeholder("NAME");
  command.flag("--json", options->json, "Print the figures as JSON, every sample included");
  command.action([options, &context, arguments] { return bench(*options, context, arguments); });
}

}  // namespace lightloom::cli
