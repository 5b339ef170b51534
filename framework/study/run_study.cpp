#include "framework/study/run_study.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/image/png.hpp"
#include "framework/study/judge.hpp"
#include "framework/study/render_reference.hpp"
#include "framework/study/time_estimate.hpp"

namespace lightloom::study {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A device that is opened at its first use, and anew after something failed on it.
class OwnDevice {
 public:
  explicit OwnDevice(const gpu::DeviceOptions& options) : options_(options) {}
  gpu::Device& get() {
    if (!device_) device_ = std::make_unique<gpu::Device>(options_);
    return *device_;
  }
  void drop() { device_.reset(); }

 private:
  gpu::DeviceOptions options_;
  std::unique_ptr<gpu::Device> device_;
};

class StudyRunner {
 public:
  StudyRunner(const StudyPlan& plan, const StudyFolder& folder, const gpu::DeviceOptions& device,
              const ProgressCallback& on_progress)
      : plan_(plan), folder_(folder), device_(device), on_progress_(on_progress), state_(find_state(plan, folder)) {}

  RunProblems run() {
    total_ = plan_.references.size() + plan_.cells.size();
    done_ = total_ - state_.missing();
    learn_times();
    tell();
    for_each(plan_.references.size(), state_.references,
             [&](size_t i, OwnDevice& device) { make_reference(i, device); });
    // Settings that come to the same share a cell: the second finds what the first has made.
    const std::vector<bool> repeated = find_repeated();
    std::vector<bool> skipped = state_.cells;
    for (size_t i = 0; i < skipped.size(); ++i) skipped[i] = skipped[i] || repeated[i];
    const auto work = [&](size_t i, OwnDevice& device) { make_cell(i, device); };
    for_each(plan_.cells.size(), skipped, work);
    for (size_t i = 0; i < skipped.size(); ++i) skipped[i] = state_.cells[i] || !repeated[i];
    for_each(plan_.cells.size(), skipped, work);
    return std::move(problems_);
  }

 private:
  std::vector<bool> find_repeated() const {
    std::set<std::string> seen;
    std::vector<bool> repeated;
    for (const PlannedCell& cell : plan_.cells) repeated.push_back(!seen.insert(cell.key).second);
    return repeated;
  }

  /// What earlier runs took is the best guess for what is left.
  void learn_times() {
    for (const PlannedCell& cell : plan_.cells)
      if (const auto record = folder_.load_cell(cell.key)) estimate_.add(cell.row, record->seconds);
  }

  /// `work` on every index that is not done, in order, by as many threads as there are jobs.
  template <typename Work>
  void for_each(size_t count, const std::vector<bool>& finished, const Work& work) {
    std::atomic<size_t> next{0};
    const auto worker = [&] {
      OwnDevice device(device_);
      for (size_t i = next++; i < count && !failure_seen(); i = next++)
        if (!finished[i])
          guarded([&] {
            stop_if_interrupted();
            work(i, device);
          });
    };
    const size_t missing = static_cast<size_t>(std::count(finished.begin(), finished.end(), false));
    const size_t threads = std::min<size_t>(plan_.spec.jobs, missing);
    if (threads <= 1) {
      worker();
    } else {
      std::vector<std::jthread> pool;
      for (size_t i = 0; i < threads; ++i) pool.emplace_back(worker);
    }
    if (failure_) std::rethrow_exception(failure_);
  }

  /// An exception must not end in a thread.
  template <typename Call>
  void guarded(const Call& call) {
    try {
      call();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }
  bool failure_seen() {
    const std::scoped_lock lock(mutex_);
    return failure_ != nullptr;
  }

  void make_reference(size_t index, OwnDevice& device) {
    const PlannedReference& reference = plan_.references[index];
    gpu::Device& opened = device.get();
    const Clock::time_point start = Clock::now();
    try {
      const RenderedReference made = render_reference(opened, plan_, reference, [this] { tick(); });
      folder_.save_reference(reference.key, made.radiance, made.record);
    } catch (const Error& error) {
      device.drop();
      for (size_t row = 0; row < plan_.rows.size(); ++row)
        if (plan_.rows[row].plan && plan_.rows[row].reference == index)
          add_problem(row, std::string("the reference: ") + error.what());
    }
    finish(reference_kind(index), seconds_since(start));
  }

  void make_cell(size_t index, OwnDevice& device) {
    const PlannedCell& cell = plan_.cells[index];
    if (!has_problem(cell.row)) {
      gpu::Device& opened = device.get();
      try {
        const Clock::time_point start = Clock::now();
        if (!folder_.has_cell(cell.key)) render_one(cell, opened, start);
        judge_one(cell);
      } catch (const Error& error) {
        device.drop();
        add_problem(cell.row, error.what());
      }
    }
    const auto record = folder_.load_cell(cell.key);
    finish(cell.row, record ? record->seconds : 0);
  }

  void render_one(const PlannedCell& cell, gpu::Device& device, Clock::time_point start) {
    const PlannedRow& row = plan_.rows[cell.row];
    const PlannedView& view = plan_.views[row.view];
    const LoadedScene& scene = *plan_.scenes[view.scene];
    const StudySpec& spec = plan_.spec;
    const Rendering rendering = render_job(device,
                                           {.plan = *row.plan,
                                            .scene = &scene.scene,
                                            .memo = scene.memo,
                                            .camera = view.camera,
                                            .seed = cell.seed,
                                            .first_frame = spec.first_frame,
                                            .frames = spec.frames,
                                            .kept = spec.judged,
                                            .frames_per_second = spec.frames_per_second,
                                            .output = spec.output,
                                            .shaders = plan_.shaders},
                                           [this] { tick(); });
    CellRecord record{rendering.times, rendering.frame_numbers, spec.jobs, seconds_since(start), rendering.warnings};
    folder_.save_cell(cell.key, rendering, record, tone_map_of(*row.plan));
  }

  void judge_one(const PlannedCell& cell) {
    const PlannedReference& reference = plan_.references[plan_.rows[cell.row].reference];
    std::vector<image::HostImage> references;
    std::vector<image::HostImage> tests;
    for (const uint32_t frame : plan_.judged_frames) {
      references.push_back(folder_.load_reference_radiance(reference.key, frame));
      tests.push_back(folder_.load_radiance(cell.key, frame));
    }
    const Judgement judgement = judge(references, tests, plan_.spec.jobs > 1 ? 1 : 0);
    image::write_png(folder_.heat_map(cell.key, reference.key), judgement.heat_map);
    folder_.save_metrics(cell.key, reference.key, judgement.metrics);
  }

  /// Kinds of work beyond the rows.
  size_t reference_kind(size_t index) const { return plan_.rows.size() + index; }

  bool has_problem(size_t row) {
    const std::scoped_lock lock(mutex_);
    return problems_.rows.contains(row);
  }
  void add_problem(size_t row, const std::string& what) {
    const std::scoped_lock lock(mutex_);
    problems_.rows.try_emplace(row, what);
  }

  void finish(size_t kind, double seconds) {
    const std::scoped_lock lock(mutex_);
    if (seconds > 0) estimate_.add(kind, seconds);
    ++done_;
    finished_kinds_.insert(kind);
    tell();
  }
  void tick() {
    stop_if_interrupted();
    const std::scoped_lock lock(mutex_);
    tell();
  }
  /// Under the lock, or before there are threads.
  void tell() {
    if (!on_progress_) return;
    on_progress_({done_, total_, estimate_.left(remaining(), plan_.spec.jobs)});
  }
  std::vector<size_t> remaining() const {
    std::vector<size_t> kinds;
    for (size_t i = 0; i < plan_.references.size(); ++i)
      if (!state_.references[i] && !finished_kinds_.contains(reference_kind(i))) kinds.push_back(reference_kind(i));
    std::multiset<size_t> finished = finished_kinds_;
    for (size_t i = 0; i < plan_.cells.size(); ++i) {
      if (state_.cells[i]) continue;
      if (const auto found = finished.find(plan_.cells[i].row); found != finished.end())
        finished.erase(found);
      else
        kinds.push_back(plan_.cells[i].row);
    }
    return kinds;
  }

  const StudyPlan& plan_;
  const StudyFolder& folder_;
  const gpu::DeviceOptions& device_;
  const ProgressCallback& on_progress_;
  const StudyState state_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  RunProblems problems_;
  TimeEstimate estimate_;
  std::multiset<size_t> finished_kinds_;
  size_t done_ = 0;
  size_t total_ = 0;
};

}  // namespace

size_t StudyState::missing() const {
  return static_cast<size_t>(std::count(references.begin(), references.end(), false) +
                             std::count(cells.begin(), cells.end(), false));
}

StudyState find_state(const StudyPlan& plan, const StudyFolder& folder) {
  StudyState state;
  for (const PlannedReference& reference : plan.references)
    state.references.push_back(folder.load_reference(reference.key).has_value());
  for (const PlannedCell& cell : plan.cells) {
    const PlannedReference& reference = plan.references[plan.rows[cell.row].reference];
    state.cells.push_back(folder.has_cell(cell.key) && folder.load_metrics(cell.key, reference.key).has_value());
  }
  return state;
}

std::optional<double> time_needed(const StudyPlan& plan, const StudyFolder& folder) {
  const StudyState state = find_state(plan, folder);
  TimeEstimate estimate;
  std::vector<size_t> missing;
  for (size_t i = 0; i < plan.cells.size(); ++i) {
    if (const auto record = folder.load_cell(plan.cells[i].key)) estimate.add(plan.cells[i].row, record->seconds);
    if (!state.cells[i]) missing.push_back(plan.cells[i].row);
  }
  return estimate.left(missing, plan.spec.jobs);
}

RunProblems run_study(const StudyPlan& plan, const StudyFolder& folder, const gpu::DeviceOptions& device,
                      const ProgressCallback& on_progress) {
  return StudyRunner(plan, folder, device, on_progress).run();
}

}  // namespace lightloom::study
