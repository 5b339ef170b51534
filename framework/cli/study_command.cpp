#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <ostream>
#include <sstream>

#include "framework/base/file.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/study_options.hpp"
#include "framework/study/evaluate.hpp"
#include "framework/study/run_study.hpp"
#include "framework/study/write_results.hpp"

namespace lightloom::cli {
namespace {

std::string number_text(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

/// What will be done, and what is already there.
void list_cells(const study::StudyPlan& plan, const study::StudyFolder& folder, std::ostream& out) {
  const study::StudyState state = study::find_state(plan, folder);
  for (size_t i = 0; i < plan.cells.size(); ++i) {
    const study::PlannedRow& row = plan.rows[plan.cells[i].row];
    const study::PlannedView& view = plan.views[row.view];
    out << (state.cells[i] ? "done  " : "to do ") << plan.scenes[view.scene]->name << " " << view.camera << "  "
        << plan.settings.list[row.setting].name << "  seed " << plan.cells[i].seed << '\n';
  }
  for (const study::PlannedRow& row : plan.rows)
    if (!row.error.empty())
      out << "cannot be run: " << plan.settings.list[row.setting].name << ": " << row.error << '\n';
  const auto missing = static_cast<size_t>(std::count(state.cells.begin(), state.cells.end(), false));
  out << plan.cells.size() << " cells of " << plan.spec.frames << " frames, " << missing << " to do, and "
      << std::count(state.references.begin(), state.references.end(), false) << " references\n";
  if (const auto seconds = study::time_needed(plan, folder))
    out << "about " << duration_text(std::chrono::duration<double>(*seconds)) << " by the cells that are done\n";
  else if (missing > 0)
    out << "how long that takes is known once a cell is done\n";
}

void print_rows(const study::StudyResults& results, std::ostream& out) {
  size_t width = 0;
  for (const study::Row& row : results.rows) width = std::max(width, row.setting.size());
  std::string view;
  for (const study::Row& row : results.rows) {
    if (const std::string name = row.scene + ", camera " + row.camera; name != view) {
      view = name;
      out << view << '\n';
    }
    out << "  " << row.setting << std::string(width - row.setting.size(), ' ') << "  ";
    if (!row.error.empty()) {
      out << "cannot be run\n";
      continue;
    }
    const study::Estimate& error = row.metrics.at(results.metric);
    out << results.metric << ' ' << number_text(error.mean);
    if (error.count > 1) out << " +- " << number_text(error.high - error.mean);
    out << "  " << number_text(row.frame_ms.mean) << " ms";
    const auto verdict = row.verdicts.find(results.metric);
    if (verdict != row.verdicts.end() && verdict->second.within_noise && error.count > 1) out << "  (within the noise)";
    out << '\n';
  }
}

ExitCode report(const study::StudyResults& results, const StudyOptions& options, const std::filesystem::path& folder,
                const CommandContext& context) {
  for (const study::Row& row : results.rows)
    if (!row.error.empty())
      print_warning(context.err, row.setting + " (" + row.scene + ", " + row.camera + "): " + row.error);
  for (const std::string& note : results.notes) context.err << "note: " << note << '\n';
  if (!options.no_times) print_rows(results, context.out);
  context.out << (folder / (options.no_times ? "results.csv" : "report.html")).string() << '\n';
  const bool any =
      std::any_of(results.rows.begin(), results.rows.end(), [](const auto& row) { return row.error.empty(); });
  return any ? ExitCode::done : ExitCode::run_failed;
}

ExitCode run(const StudyOptions& options, const CommandContext& context) {
  Diagnostics diagnostics;
  const std::optional<study::StudySpec> spec = study_spec(options, diagnostics);
  if (!spec) {
    print_diagnostics(context.err, diagnostics);
    return exit_code_of(diagnostics);
  }
  const gpu::DeviceOptions device_options{options.device, false};
  const gpu::DeviceInfo device = gpu::Device(device_options).info();
  const auto plan = study::plan_study(
      *spec, {context.registry, device, context.plugins, options.limits.load_options(), !options.cache.off},
      diagnostics);
  print_diagnostics(context.err, diagnostics);
  if (!plan) return exit_code_of(diagnostics);
  const InterruptRequests interrupts;
  const study::StudyFolder folder(options.out.empty() ? std::filesystem::path("out") / spec->name : options.out);
  if (options.fresh && !options.dry_run) folder.clear();
  if (options.dry_run) {
    list_cells(*plan, folder, context.out);
    return ExitCode::done;
  }
  study::RunProblems problems;
  {
    ProgressBar bar(context.err, context.err_is_terminal, "study", "cells",
                    plan->cells.size() + plan->references.size());
    study::ProgressCallback on_progress;
    if (context.err_is_terminal)
      on_progress = [&bar](const study::StudyProgress& progress) {
        std::optional<std::chrono::duration<double>> left;
        if (progress.seconds_left) left = std::chrono::duration<double>(*progress.seconds_left);
        bar.update(progress.done, left);
      };
    problems = study::run_study(*plan, folder, device_options, on_progress);
  }
  const study::StudyResults results = study::evaluate(*plan, folder, problems, device);
  study::write_results(results, study::cell_results(*plan, folder, results), folder.path(),
                       options.no_times ? study::Times::without : study::Times::with);
  return report(results, options, folder.path(), context);
}

}  // namespace

void add_study_command(Command& program, const CommandContext& context) {
  Command& command = program.command("study", "Measure what settings cost and what they gain, against a reference");
  command.description(
      "Renders every setting of a study in every scene and camera with every seed, compares it with a reference, and "
      "writes results.csv, cells.csv, results.json and report.html. Finished cells are kept: run it again after an "
      "interruption, or with more settings, and only what is missing is rendered. Without a file, --graph, --scene and "
      "--ablate or --sweep say what to study.");
  auto options = std::make_shared<StudyOptions>();
  options->add_to(command);
  command.action([options, &context] { return run(*options, context); });
}

}  // namespace lightloom::cli
