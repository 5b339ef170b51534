#include "framework/study/evaluate.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/image/png.hpp"
#include "framework/run/version.hpp"
#include "framework/study/draw_graph.hpp"
#include "framework/study/judge.hpp"
#include "framework/study/row_statistics.hpp"
#include "framework/study/statistics.hpp"
#include "framework/study/trade.hpp"

namespace lightloom::study {
namespace {

namespace fs = std::filesystem;

/// Letters and digits of a name, the rest as '_'.
std::string slug(const std::string& name) {
  std::string text = name;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return text.substr(0, 80);
}

class Evaluator {
 public:
  Evaluator(const StudyPlan& plan, const StudyFolder& folder, const RunProblems& problems)
      : plan_(plan), folder_(folder), problems_(problems) {}

  StudyResults run(const gpu::DeviceInfo& device) {
    const StudySpec& spec = plan_.spec;
    results_.name = spec.name;
    results_.description = spec.description;
    results_.graph = spec.graph.generic_string();
    results_.metric = metrics().front();
    results_.axes = plan_.settings.axes;
    add_provenance(device);
    prepare_pictures();
    for (size_t view = 0; view < plan_.views.size(); ++view) add_view(view);
    for (size_t row = 0; row < plan_.rows.size(); ++row) add_row(row);
    mark_pareto();
    fill_trade_tables(results_);
    add_notes();
    if (!plan_.rows.empty() && plan_.rows.front().plan) draw_graph(*plan_.rows.front().plan, results_);
    return std::move(results_);
  }

 private:
  const std::vector<std::string>& metrics() const {
    return plan_.spec.metrics.empty() ? metric_names() : plan_.spec.metrics;
  }

  void add_provenance(const gpu::DeviceInfo& device) {
    const StudySpec& spec = plan_.spec;
    std::vector<std::string> seeds;
    for (const uint32_t seed : spec.seeds) seeds.push_back(std::to_string(seed));
    std::ostringstream rate;
    rate << spec.frames_per_second;
    results_.provenance = {{"device", device.name},
                           {"driver", device.driver + " " + device.driver_info},
                           {"version", run::version()},
                           {"commit", run::commit()},
                           {"seeds", join(seeds, ", ")},
                           {"frames", std::to_string(spec.frames) + " from " + std::to_string(spec.first_frame)},
                           {"frames not timed", std::to_string(spec.warm_up)},
                           {"frames judged", "the last " + std::to_string(spec.judged)},
                           {"frames per second", rate.str()}};
    if (!plan_.rows.empty() && plan_.rows.front().plan) {
      const Graph& graph = plan_.rows.front().plan->graph;
      results_.provenance.emplace_back("size", size_text({graph.view.width, graph.view.height}));
      results_.provenance.emplace_back("trace size", size_text({graph.trace.width, graph.trace.height}));
    }
  }

  /// Pictures of settings that are no more must not stay.
  void prepare_pictures() const {
    std::error_code error;
    fs::remove_all(folder_.path() / "pictures", error);
    fs::create_directories(folder_.path() / "pictures", error);
    if (error)
      throw Error(ExitCode::run_failed,
                  "cannot make '" + (folder_.path() / "pictures").string() + "': " + error.message());
  }

  /// A name for a picture that nothing else has.
  fs::path new_picture(const std::string& name) {
    std::string unique = slug(name);
    for (uint32_t i = 2; !pictures_.insert(unique).second; ++i) unique = slug(name) + "-" + std::to_string(i);
    return fs::path("pictures") / (unique + ".png");
  }

  std::string view_name(size_t view) const {
    return plan_.scenes[plan_.views[view].scene]->name + "-" + plan_.views[view].camera;
  }

  void add_view(size_t index) {
    View view{plan_.scenes[plan_.views[index].scene]->name, plan_.views[index].camera, {}, 0, {}};
    const PlannedRow& baseline =
        *std::find_if(plan_.rows.begin(), plan_.rows.end(), [&](const PlannedRow& row) { return row.view == index; });
    const PlannedReference& reference = plan_.references[baseline.reference];
    if (const auto record = folder_.load_reference(reference.key)) {
      view.reference = new_picture(view_name(index) + "-reference");
      image::write_png(folder_.path() / view.reference,
                       tone_map(folder_.load_reference_radiance(reference.key, record->frame_numbers.back()),
                                tone_map_of(*baseline.plan)));
      view.reference_relmse = record->relmse;
      view.reference_note = record->note;
    }
    results_.views.push_back(std::move(view));
  }

  std::vector<const PlannedCell*> cells_of(size_t row) const {
    std::vector<const PlannedCell*> cells;
    for (const PlannedCell& cell : plan_.cells)
      if (cell.row == row) cells.push_back(&cell);
    return cells;
  }

  RowSamples samples_of(size_t row) const {
    RowSamples samples;
    for (const PlannedCell* cell : cells_of(row)) {
      auto record = folder_.load_cell(cell->key);
      auto values = folder_.load_metrics(cell->key, plan_.references[plan_.rows[row].reference].key);
      if (!record || !values) return {};
      samples.cells.push_back(std::move(*record));
      samples.metrics.push_back(std::move(*values));
    }
    return samples;
  }

  void add_row(size_t index) {
    const PlannedRow& planned = plan_.rows[index];
    const Setting& setting = plan_.settings.list[planned.setting];
    Row& row = results_.rows.emplace_back();
    row.setting = setting.name;
    row.scene = results_.views[planned.view].scene;
    row.camera = results_.views[planned.view].camera;
    row.values = setting.values;
    row.command = planned.command;
    row.error = planned.error;
    if (planned.setting == 0) baseline_ = index;
    if (const auto problem = problems_.rows.find(index); problem != problems_.rows.end()) row.error = problem->second;
    if (!row.error.empty()) return;
    const RowSamples samples = samples_of(index);
    if (samples.cells.empty()) {
      row.error = "its cells are missing";
      return;
    }
    if (planned.setting == 0) baseline_samples_ = samples;
    fill_measurements(row, samples, metrics(), plan_.spec.warm_up);
    if (plan_.rows[baseline_].plan) fill_missing_passes(row, *planned.plan, *plan_.rows[baseline_].plan);
    if (planned.setting != 0 && results_.rows[baseline_].error.empty())
      fill_verdicts(row, samples, baseline_samples_, metrics(), plan_.spec.warm_up);
    fill_split(row, index);
    copy_pictures(row, index);
  }

  void fill_split(Row& row, size_t index) const {
    const std::vector<const PlannedCell*> cells = cells_of(index);
    if (cells.size() < 2) return;
    const uint32_t frame = plan_.judged_frames.back();
    std::vector<image::HostImage> images;
    for (const PlannedCell* cell : cells) images.push_back(folder_.load_radiance(cell->key, frame));
    const std::string& reference = plan_.references[plan_.rows[index].reference].key;
    const ErrorSplit split =
        split_error(error_products(folder_.load_reference_radiance(reference, frame), images), cells.size());
    row.bias_squared = split.bias_squared;
    row.variance = split.variance;
  }

  void copy_pictures(Row& row, size_t index) {
    const PlannedRow& planned = plan_.rows[index];
    const std::string& key = cells_of(index).front()->key;
    const std::string name = view_name(planned.view) + "-" + row.setting;
    row.picture = new_picture(name);
    row.heat_map = new_picture(name + "-flip");
    const auto copy = [&](const fs::path& from, const fs::path& to) {
      std::error_code error;
      fs::copy_file(from, folder_.path() / to, fs::copy_options::overwrite_existing, error);
      if (error)
        throw Error(ExitCode::run_failed, "cannot write '" + (folder_.path() / to).string() + "': " + error.message());
    };
    copy(folder_.picture(key), row.picture);
    copy(folder_.heat_map(key, plan_.references[planned.reference].key), row.heat_map);
  }

  /// For error: metrics where more is better are turned round.
  void mark_pareto() {
    const double sign = results_.metric == "psnr" || results_.metric == "ssim" ? -1 : 1;
    for (const View& view : results_.views) {
      std::vector<Row*> rows;
      std::vector<Point> points;
      for (Row& row : results_.rows) {
        if (!row.error.empty() || row.scene != view.scene || row.camera != view.camera) continue;
        rows.push_back(&row);
        points.push_back({row.frame_ms.mean, sign * row.metrics.at(results_.metric).mean});
      }
      const std::vector<bool> front = pareto_front(points);
      for (size_t i = 0; i < rows.size(); ++i) rows[i]->pareto = front[i];
    }
  }

  void add_notes() {
    const auto any = [&](const auto& which) { return std::any_of(results_.rows.begin(), results_.rows.end(), which); };
    if (plan_.spec.seeds.size() == 1)
      results_.notes.emplace_back("One seed: nothing is known of the noise, and no difference can be told from it");
    if (any([](const Row& row) { return row.disturbed; })) results_.notes.emplace_back(kDisturbedNote);
    if (plan_.spec.reference.kind == ReferenceSpec::Kind::baseline)
      results_.notes.emplace_back("No reference was given: errors are differences from the baseline's own mean image");
    if (any([](const Row& row) { return row.error.empty() && row.bias_squared.mean < 0; }))
      results_.notes.emplace_back(
          "Bias squared is an unbiased estimate: where there is none, it is a little below zero at times");
    for (const View& view : results_.views)
      for (const Row& row : results_.rows)
        if (row.scene == view.scene && row.camera == view.camera && row.metrics.contains("relmse") &&
            row.metrics.at("relmse").mean < 4 * view.reference_relmse) {
          results_.notes.push_back("In " + view.scene + ", camera " + view.camera +
                                   ", the reference's own noise is more than a quarter of some relMSE");
          break;
        }
    for (const std::string& warning : problems_.warnings) results_.notes.push_back(warning);
  }

  const StudyPlan& plan_;
  const StudyFolder& folder_;
  const RunProblems& problems_;
  StudyResults results_;
  std::set<std::string> pictures_;
  size_t baseline_ = 0;
  RowSamples baseline_samples_;
};

}  // namespace

StudyResults evaluate(const StudyPlan& plan, const StudyFolder& folder, const RunProblems& problems,
                      const gpu::DeviceInfo& device) {
  return Evaluator(plan, folder, problems).run(device);
}

std::vector<CellResult> cell_results(const StudyPlan& plan, const StudyFolder& folder, const StudyResults& results) {
  std::vector<CellResult> cells;
  for (const PlannedCell& cell : plan.cells) {
    if (!results.rows[cell.row].error.empty()) continue;
    const auto record = folder.load_cell(cell.key);
    const auto values = folder.load_metrics(cell.key, plan.references[plan.rows[cell.row].reference].key);
    if (!record || !values) continue;
    const std::vector<double> wall(
        record->times.wall.begin() + std::min<std::ptrdiff_t>(plan.spec.warm_up, std::ssize(record->times.wall)),
        record->times.wall.end());
    cells.push_back({cell.row, cell.seed, cell.key, *values,
                     percentile(frame_times(record->times, plan.spec.warm_up), 0.5), percentile(wall, 0.5)});
  }
  return cells;
}

}  // namespace lightloom::study
