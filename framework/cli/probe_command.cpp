#include <memory>
#include <ostream>

#include "framework/base/interrupt.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/picture_options.hpp"
#include "framework/cli/probe_report.hpp"

namespace lightloom::cli {
namespace {

struct ProbeOptions {
  PictureOptions picture;
  std::string pixel;
  bool every = false;
  bool json = false;
  bool explain = false;
  std::string device;
  bool no_alias = false;
  bool validate = false;
};

struct Pixel {
  uint32_t x = 0;
  uint32_t y = 0;
};

/// Returns what is wrong, or "".
std::string parse_pixel(std::string_view text, Pixel& pixel) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 2 || !parse_value(parts[0], pixel.x).empty() || !parse_value(parts[1], pixel.y).empty())
    return "expected two whole numbers X,Y, not " + in_quotes(text);
  return {};
}

ExitCode probe(const ProbeOptions& options, const CommandContext& context) {
  const InterruptRequests interrupts;
  Pixel pixel;
  static_cast<void>(parse_pixel(options.pixel, pixel));
  run::ProbeRequest request{
      .render = options.picture.request(context), .x = pixel.x, .y = pixel.y, .every = options.every};
  request.render.share_memory = !options.no_alias;
  request.render.device = {options.device, options.validate};
  const uint32_t frames = request.render.last_frame - request.render.first_frame + 1;
  Diagnostics diagnostics;
  run::ProbeReport report;
  bool done = false;
  {
    ProgressBar bar(context.err, context.err_is_terminal, "probe", frames == 1 ? "frame" : "frames", frames);
    done = run::probe(
        request, context.registry, [&bar](uint32_t frame, uint32_t) { bar.update(frame); }, diagnostics, report);
  }
  print_diagnostics(context.err, diagnostics);
  if (!done) return exit_code_of(diagnostics);
  for (const std::string& warning : report.warnings) print_warning(context.err, warning);
  if (options.json)
    context.out << probe_json(report, pixel.x, pixel.y).dump(2) << "\n";
  else
    print_probe(context.out, report, pixel.x, pixel.y, options.explain);
  return ExitCode::done;
}

}  // namespace

void add_probe_command(Command& program, const CommandContext& context) {
  Command& command =
      program.command("probe", "Follow one pixel through a graph: what each pass reads and writes there");
  command.description(
      "Renders the frames and prints, for the last of them, each pass in execution order with its params and the "
      "texels "
      "of its inputs, outputs and scratch images that stand for the pixel: images of the view's size at that pixel, "
      "others at the texel that covers its centre, volumes at the voxel that holds the surface point which the pixel "
      "sees. Histories are shown with their ages. Every value is the one that a render with the same options has; "
      "passes that it leaves out do not run here either (--dump PASS.PORT makes them run). Nothing is written.");
  auto options = std::make_shared<ProbeOptions>();
  options->picture.add_graph_to(command);
  command.positional("X,Y", options->pixel, "Pixel of the view; 0,0 is at the top left")
      .required()
      .check([](std::string_view text) {
        Pixel pixel;
        return parse_pixel(text, pixel);
      });
  options->picture.add_to(command);
  command.flag("--every", options->every, "Report every frame instead of the last one").group("Scene and frames");
  command.flag("--explain", options->explain, "Also print what each pass says that its values mean");
  command.flag("--json", options->json, "Print JSON");
  command.option("--device", options->device, "Device by index or part of its name; 'lightloom devices' lists them")
      .placeholder("NAME");
  command.flag("--no-alias", options->no_alias, "Give every value memory of its own");
  command.flag("--validate", options->validate, "Check each Vulkan call by the validation layers (slow)");
  command.action([options, &context] { return probe(*options, context); });
}

}  // namespace lightloom::cli
