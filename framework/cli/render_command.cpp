#include <cmath>
#include <memory>
#include <ostream>
#include <sstream>

#include "framework/base/interrupt.hpp"
#include "framework/base/progress.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/picture_options.hpp"
#include "framework/cli/watch.hpp"
#include "framework/run/render.hpp"

namespace lightloom::cli {
namespace {

struct RenderOptions {
  PictureOptions picture;
  std::filesystem::path out;
  std::string dump_format = "exr";
  std::optional<std::string> dump_frames;
  std::optional<std::string> output_frames;
  uint32_t checkpoint_every = 0;
  double checkpoint_minutes = 0;
  bool resume = false;
  bool watch = false;
  std::string device;
  bool no_alias = false;
  bool no_times = false;
  bool validate = false;
  run::CheckOptions checks;
};

/// The frames that an option chooses among those that are rendered, at least one.
run::FrameSet chosen_frames(const char* option, const std::optional<std::string>& text, const Range& rendered) {
  run::FrameSet chosen;
  if (text) static_cast<void>(run::parse_frame_set(*text, chosen));  // was checked when the option was read
  if (chosen.meets(rendered.first, rendered.last)) return chosen;
  throw Error(ExitCode::usage, std::string("option '") + option + "': " + *text + " has none of the frames " +
                                   format_value(rendered) + " that are rendered");
}

run::RenderRequest make_request(const RenderOptions& options, const CommandContext& context,
                                const std::vector<std::string>& arguments) {
  run::RenderRequest request = options.picture.request(context);
  request.dump_format = options.dump_format == "npy" ? run::DumpFormat::npy : run::DumpFormat::exr;
  request.output_frames = chosen_frames("--output-frames", options.output_frames, options.picture.frames);
  request.dump_frames = chosen_frames("--dump-frames", options.dump_frames, options.picture.frames);
  if (options.dump_frames && options.picture.changes.dumps.empty())
    throw Error(ExitCode::usage, "option '--dump-frames' needs '--dump', which says what to write");
  request.share_memory = !options.no_alias;
  request.checks = options.checks;
  request.time_passes = !options.no_times;
  request.checkpoint_every = options.checkpoint_every;
  request.checkpoint_time = std::chrono::duration<double, std::ratio<60>>(options.checkpoint_minutes);
  request.resume = options.resume;
  request.out = options.out.empty() ? std::filesystem::path("out") / options.picture.graph.stem() : options.out;
  request.device = {options.device, options.validate};
  request.command_line = {"lightloom"};
  request.command_line.insert(request.command_line.end(), arguments.begin(), arguments.end());
  return request;
}

/// Three digits, more only before the point.
std::string milliseconds_text(double milliseconds) {
  std::ostringstream text;
  if (milliseconds >= 100) {
    text << std::llround(milliseconds);
  } else {
    text.precision(3);
    text << milliseconds;
  }
  return text.str() + " ms";
}

void report(const run::RenderSummary& summary, std::ostream& out) {
  out << summary.frames << (summary.frames == 1 ? " frame in " : " frames in ") << summary.folder.string() << ", "
      << milliseconds_text(summary.milliseconds_per_frame) << " a frame (median)";
  if (summary.frames_resumed > 0) out << "; " << summary.frames_resumed << " were there already";
  out << '\n';
  if (!summary.picture.empty()) out << summary.picture.string() << '\n';
}

ExitCode interrupted(const run::RenderSummary& summary, uint32_t wanted, bool has_checkpoint,
                     const CommandContext& context) {
  print_error(context.err,
              "interrupted by " + signal_name(summary.interrupted_by) + " after " + std::to_string(summary.frames) +
                  " of " + std::to_string(wanted) + " frames, which are whole",
              has_checkpoint ? "the same command with --resume goes on from the last checkpoint"
                             : "with --checkpoint, a render can go on where it was stopped");
  return interrupted_code(summary.interrupted_by);
}

ExitCode render(const RenderOptions& options, const CommandContext& context,
                const std::vector<std::string>& arguments) {
  const InterruptRequests interrupts;
  const run::RenderRequest request = make_request(options, context, arguments);
  const uint32_t frames = request.last_frame - request.first_frame + 1;
  if (options.watch && (options.checkpoint_every > 0 || options.checkpoint_minutes > 0 || options.resume))
    throw Error(ExitCode::usage,
                "option '--watch' renders from the first frame again, so it goes without '--checkpoint' "
                "and '--resume'");
  if (options.watch) watch(request, context, [&](const run::RenderSummary& summary) { report(summary, context.out); });
  Diagnostics diagnostics;
  run::RenderSummary summary;
  bool rendered = false;
  {
    ProgressBar bar(context.err, context.err_is_terminal, "render", frames == 1 ? "frame" : "frames", frames);
    rendered = run::render(
        request, context.registry, [&bar](uint32_t done, uint32_t) { bar.update(done); }, diagnostics, summary);
  }
  print_diagnostics(context.err, diagnostics);
  if (!rendered) return exit_code_of(diagnostics);
  for (const std::string& warning : summary.warnings) print_warning(context.err, warning);
  report(summary, context.out);
  for (const std::string& failure : summary.failures) print_error(context.err, failure, "");
  if (summary.interrupted_by != 0)
    return interrupted(summary, frames, options.checkpoint_every > 0 || options.checkpoint_minutes > 0, context);
  return summary.failures.empty() ? ExitCode::done : ExitCode::run_failed;
}

void add_frame_choices(Command& command, RenderOptions& options) {
  const auto check = [](std::string_view text) {
    run::FrameSet parsed;
    return run::parse_frame_set(text, parsed);
  };
  const auto add = [&](const char* name, std::optional<std::string>& frames, const char* doc) {
    command.option(name, frames, doc).placeholder("FRAMES").default_text("all").check(check).group("Scene and frames");
  };
  add("--output-frames", options.output_frames,
      "Write the graph's outputs of these frames only, such as 0..3,10,20..100:10 (every tenth) or 99..:100");
  add("--dump-frames", options.dump_frames, "Write what --dump asks for of these frames only");
}

}  // namespace

void add_render_command(Command& program, const CommandContext& context, const std::vector<std::string>& arguments) {
  Command& command = program.command("render", "Render frames of a scene by a graph, into a run folder");
  command.description(
      "Writes each frame's outputs (radiance.FFFF.exr, image.FFFF.png), the dumped values (dumps/FFFF/PASS.PORT.exr or "
      ".npy) and run.json, which records all that the pictures depend on and the time of each pass.");
  auto options = std::make_shared<RenderOptions>();
  options->picture.add_graph_to(command);
  options->picture.add_to(command);
  command.option("--dump-format", options->dump_format, "How --dump writes images: OpenEXR, or NumPy arrays (y, x, c)")
      .choices({"exr", "npy"});
  add_frame_choices(command, *options);
  command.option("-o,--out", options->out, "Run folder, made if missing")
      .placeholder("DIR")
      .default_text("out/ and the graph file's name");
  command
      .option("--checkpoint", options->checkpoint_every,
              "Save what the next frame needs into the run folder every so many frames, and at the end")
      .placeholder("FRAMES")
      .range(1, kLastFrame)
      .default_text("none")
      .group("Long runs");
  command
      .option("--checkpoint-minutes", options->checkpoint_minutes,
              "The same whenever so much time has gone by, at the end of a frame; goes with --checkpoint, or alone")
      .placeholder("MINUTES")
      .range(0, 100'000)
      .default_text("none")
      .group("Long runs");
  command
      .flag("--resume", options->resume,
            "Go on from the run folder's checkpoint, if there is one: the pictures are those of a run that never "
            "stopped")
      .group("Long runs");
  command.flag("--watch", options->watch,
               "Render again whenever the graph, a shader, the scene or the camera path changes, until Ctrl-C; what is "
               "wrong with them is said, and the pictures before stay");
  command.option("--device", options->device, "Device by index or part of its name; 'lightloom devices' lists them")
      .placeholder("NAME");
  command.flag(
      "--no-alias", options->no_alias,
      "Give every value memory of its own, also those that are not live at the same time; the pictures are the "
      "same");
  command
      .flag("--find-nan", options->checks.find_nan,
            "Look for NaN and infinity in every value of every frame, and name the passes that made them; the pictures "
            "are the same")
      .group("Checks");
  command
      .flag("--stop-at-nan", options->checks.stop_at_nan,
            "The same, and end after the frame with the first one, with exit code 1")
      .group("Checks");
  command
      .flag("--poison", options->checks.poison,
            "Fill every image with rare numbers before it is written and after its last use, and name the passes that "
            "read what nobody wrote, or leave texels unwritten: then with exit code 1. Renders everything twice; the "
            "pictures are the same")
      .group("Checks");
  command.flag("--no-times", options->no_times,
               "Do not time each pass on its own, which keeps passes apart that may overlap; run.json then has the "
               "times of whole frames alone; the pictures are the same");
  command.flag("--validate", options->validate, "Check each Vulkan call by the validation layers (slow)");
  command.action([options, &context, arguments] { return render(*options, context, arguments); });
}

}  // namespace lightloom::cli
