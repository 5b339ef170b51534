#include <algorithm>
#include <memory>
#include <ostream>

#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/comparison.hpp"
#include "framework/cli/comparison_report.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/image/metric_names.hpp"

namespace lightloom::cli {
namespace {

constexpr double kMostPixelsPerDegree = 1000;

struct CompareOptions {
  LimitOptions limits;
  ComparisonRequest request;
  std::string flip;
  std::string crop;
  std::string only;
  bool json = false;
};

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const image::NamedMetric& metric : image::kNamedMetrics) names.emplace_back(metric.name);
  return names;
}

/// X,Y,WxH. Returns what is wrong, or "".
std::string parse_crop(std::string_view text, image::PixelBox& box) {
  const std::vector<std::string> parts = split(text, ',');
  Size size;
  const bool good = parts.size() == 3 && parse_value(parts[0], box.x).empty() && parse_value(parts[1], box.y).empty() &&
                    parse_value(parts[2], size).empty();
  box.width = size.width;
  box.height = size.height;
  return good ? "" : "expected X,Y,WIDTHxHEIGHT such as 100,50,64x64, got " + in_quotes(text);
}

std::string check_crop(std::string_view text) {
  image::PixelBox box;
  return parse_crop(text, box);
}

std::string check_only(std::string_view text) {
  const std::vector<std::string> known = metric_names();
  for (const std::string& name : split(text, ','))
    if (std::find(known.begin(), known.end(), name) == known.end())
      return "there is no metric " + in_quotes(name) + "; " + did_you_mean(name, known, "there are");
  return "";
}

std::string check_extension(std::string_view text, const std::vector<std::string>& extensions) {
  const std::string extension = std::filesystem::path(text).extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return "";
  return "expected a file name that ends in " + join(extensions, " or ") + ", got " + in_quotes(text);
}

std::vector<std::string> wanted_metrics(const CompareOptions& options) {
  return options.only.empty() ? std::vector<std::string>() : split(options.only, ',');
}

ComparisonRequest complete_request(const CompareOptions& options) {
  ComparisonRequest request = options.request;
  request.read.limits = options.limits.load_options().limits;
  const std::vector<std::string> wanted = wanted_metrics(options);
  const auto has = [&wanted](const char* name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  request.metrics.with_flip = has("flip");
  request.metrics.with_ssim = has("ssim");
  if (!options.flip.empty()) request.flip = options.flip == "ldr" ? image::FlipKind::ldr : image::FlipKind::hdr;
  if (!options.crop.empty()) (void)parse_crop(options.crop, request.crop.emplace());
  return request;
}

ExitCode compare(const CompareOptions& options, const CommandContext& context) {
  const ComparisonRequest request = complete_request(options);
  Comparison comparison;
  {
    std::optional<ProgressBar> bar;
    comparison = compare_files(request, [&](uint32_t done, uint32_t total) {
      if (total == 1) return;
      if (!bar) bar.emplace(context.err, context.err_is_terminal, "compare", "frames", total);
      bar->update(done);
    });
  }
  for (const std::string& warning : comparison.warnings) print_warning(context.err, warning);
  const std::vector<std::string> wanted = wanted_metrics(options);
  if (options.json) {
    context.out << comparison_json(comparison, wanted).dump(2) << '\n';
  } else {
    context.out << comparison_text(comparison, wanted, request.metrics);
  }
  return ExitCode::done;
}

void add_metric_options(Command& command, CompareOptions& options) {
  ComparisonRequest& request = options.request;
  command.option("--only", options.only, "Only these, with commas between them; what is left out costs no time")
      .placeholder("METRIC,...")
      .check(check_only)
      .group("Metrics");
  command.option("--flip", options.flip, "FLIP of display values in 0..1 (ldr), or of radiance (hdr)")
      .choices({"ldr", "hdr"})
      .default_text("ldr if both have 8 or 16 bits a sample, else hdr")
      .group("Metrics");
  command
      .option("--ppd", request.metrics.pixels_per_degree,
              "Pixels in a degree of the viewer's sight, for FLIP: 0.7 m from a 0.7 m wide screen of 3840 pixels")
      .range(1, kMostPixelsPerDegree)
      .group("Metrics");
  command.option("--epsilon", request.metrics.epsilon, "Added to the denominators of relmse and mape")
      .range(1e-30, 1e30)
      .group("Metrics");
  command
      .option("--firefly-factor", request.metrics.firefly_factor,
              "A firefly is brighter than this times the reference, or epsilon where that is darker")
      .range(1e-30, 1e30)
      .group("Metrics");
}

void add_input_options(Command& command, CompareOptions& options) {
  ComparisonRequest& request = options.request;
  command.option("--output", request.output, "Output whose frames are taken from run folders")
      .placeholder("NAME")
      .group("Images");
  command
      .option("--channel", request.read.channel,
              "Channel, or layer NAME of NAME.R, NAME.G, NAME.B, of files that name them; R, G, B unless given")
      .placeholder("NAME")
      .group("Images");
  command.flag("--linear", request.read.linear, "Take 8 and 16 bit samples as they are, not as sRGB").group("Images");
  command.option("--crop", options.crop, "Compare only this part, from the upper left corner [pixels]")
      .placeholder("X,Y,WxH")
      .check(check_crop)
      .group("Images");
}

}  // namespace

void add_compare_command(Command& program, const CommandContext& context) {
  Command& command = program.command("compare", "Measure the error of an image or a sequence against a reference");
  command.description(
      "R and T are image files, run folders of 'lightloom render', or patterns with %04d or #### for the frame number; "
      "one R serves for all frames of T. Any format that OpenImageIO reads, and .npy dumps. 8 and 16 bit samples are "
      "taken as sRGB and made linear. What each figure means: docs/metrics.md.");
  auto options = std::make_shared<CompareOptions>();
  command.positional("R", options->request.reference, "Reference").required();
  command.positional("T", options->request.test, "Test").required();
  add_input_options(command, *options);
  add_metric_options(command, *options);
  command.option("--heat-map", options->request.heat_map, "Write FLIP of each pixel in colours (magma, 0 to 1), PNG")
      .check([](std::string_view text) { return check_extension(text, {".png"}); });
  command
      .option("--error-map", options->request.error_map,
              "Write the relative error |T - R| / (|R| + epsilon) of each pixel, as colours (PNG) or numbers (EXR)")
      .check([](std::string_view text) {
        return check_extension(text, {".png", ".exr"});
      });
  options->limits.add_limits_to(command);
  command.flag("--json", options->json, "Print JSON; null where a figure is infinite or undefined");
  command.action([options, &context] { return compare(*options, context); });
}

}  // namespace lightloom::cli
