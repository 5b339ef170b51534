#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "framework/base/atomic_file.hpp"
#include "framework/base/file.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/base/progress.hpp"
#include "framework/cli/cache_option.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/text_layout.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/run/version.hpp"
#include "framework/stability/results.hpp"
#include "framework/stability/run_checks.hpp"

namespace lightloom::cli {
namespace {

using stability::Check;
using stability::Outcome;

struct StabilityOptions {
  std::vector<std::string> checks;
  std::filesystem::path out;
  CacheOption cache;
  std::string device;
  bool validate = false;
  bool slow = false;
  bool list = false;
  bool json = false;
  bool markdown = false;
};

void print_list(const std::vector<const Check*>& checks, std::ostream& out) {
  std::vector<std::vector<std::string>> rows = {{"CHECK", "GROUP", "EXTREME"}};
  for (const Check* check : checks)
    rows.push_back({check->name, check->group, check->extreme + (check->slow ? " (slow)" : "")});
  out << align_columns(rows);
}

void print_outcome(const Outcome& outcome, std::ostream& out) {
  out << (passed(outcome) ? "ok      " : "MISSED  ") << outcome.check->name << ": " << outcome.check->extreme << '\n';
  std::vector<std::vector<std::string>> rows;
  for (const stability::Figure& figure : outcome.figures)
    rows.push_back({"       ", figure.what, stability::figure_text(figure)});
  if (!rows.empty()) out << align_columns(rows);
  if (!outcome.failure.empty()) out << "        " << outcome.failure << '\n';
  out.flush();
}

std::vector<Outcome> run_all(const std::vector<const Check*>& checks, stability::Lab& lab, bool print,
                             const CommandContext& context) {
  std::vector<Outcome> outcomes;
  ProgressBar bar(context.err, context.err_is_terminal, "stability", "checks", checks.size());
  for (const Check* check : checks) {
    outcomes.push_back(run_check(*check, lab));
    if (print) print_outcome(outcomes.back(), context.out);
    bar.update(outcomes.size());
  }
  return outcomes;
}

/// The table as a document with its title and the command that makes it.
std::string document_of(const std::string& table) {
  return "# Stability\n\nMade by `lightloom stability --slow --validate --markdown`; do not edit. Each row is an "
         "extreme, measured on\nthe device named below by the graphs that ship or parts of them; "
         "`ctest -L stability` runs the same.\n\n" +
         table;
}

void give_tables(const std::vector<Outcome>& outcomes, const stability::TableOrigin& origin,
                 const StabilityOptions& options, const CommandContext& context) {
  const std::string json = stability::to_json(outcomes, origin).dump(2) + "\n";
  const std::string document = document_of(stability::to_markdown(outcomes, origin));
  if (options.json) context.out << json;
  if (options.markdown) context.out << document;
  if (options.out.empty()) return;
  make_folder(options.out);
  write_file_atomically(options.out / "stability.json", json);
  write_file_atomically(options.out / "stability.md", document);
  write_file_atomically(options.out / "report.html", stability::to_html(outcomes, origin));
}

ExitCode measure(const StabilityOptions& options, const CommandContext& context) {
  const std::vector<Check> all = stability::all_checks();
  const std::vector<const Check*> chosen = stability::choose_checks(all, options.checks, options.slow || options.list);
  if (options.list) {
    print_list(chosen, context.out);
    return ExitCode::done;
  }
  const InterruptRequests interrupts;
  gpu::Device device({options.device, options.validate});
  stability::Lab lab(device, context.registry, options.cache.apply_to(run::default_shader_folders()));
  const bool print = !options.json && !options.markdown;
  const std::vector<Outcome> outcomes = run_all(chosen, lab, print, context);
  const stability::TableOrigin origin{device.info(), options.validate,
                                      "lightloom " + run::version() + " (commit " + run::commit() + ")"};
  give_tables(outcomes, origin, options, context);
  const auto missed =
      std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& outcome) { return !passed(outcome); });
  if (missed == 0) return ExitCode::done;
  throw Error(
      ExitCode::run_failed,
      std::to_string(missed) + " of " + std::to_string(outcomes.size()) + " stability checks missed their bounds",
      "the rows marked MISSED (or **no**) tell which, and by how much");
}

}  // namespace

void add_stability_command(Command& program, const CommandContext& context) {
  Command& command = program.command("stability", "Push the renderer to its extremes on this device, against bounds");
  command.description(
      "Each check takes one thing to its limit (the scale of the scene, radiance, roughness, the number of frames, "
      "numbers that are none, ...), renders, and prints what it measured beside the bound that must hold. Exits with 1 "
      "where one is missed.");
  auto options = std::make_shared<StabilityOptions>();
  command.positional("CHECK", options->checks, "Checks or groups of them, '*' stands for any text")
      .default_text("all that are not slow");
  command.flag("--slow", options->slow, "Also those that take more than about ten seconds");
  command.flag("--list", options->list, "List the checks instead of running them");
  command
      .option("--out", options->out, "Also write the table into this folder: report.html, stability.md, stability.json")
      .placeholder("DIR");
  command.flag("--json", options->json, "Print JSON");
  command.flag("--markdown", options->markdown, "Print the document docs/stability.md");
  options->cache.add_to(command);
  command.option("--device", options->device, "Device by index or part of its name; 'lightloom devices' lists them")
      .placeholder("NAME");
  command.flag("--validate", options->validate, "Check each Vulkan call by the validation layers (slow)");
  command.action([options, &context] { return measure(*options, context); });
}

}  // namespace lightloom::cli
