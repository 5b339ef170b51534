#include "framework/study/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>

namespace lightloom::study {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A run that is set up, and what it has cost so far.
class Measured {
 public:
  Measured(gpu::Device& device, const scene::Scene& scene, const BenchRun& run) : device_(&device) {
    figures_.name = run.name;
    figures_.plan_ms = run.plan_ms;
    run::ExecutorOptions options = run.options;
    if (!options.library) options.library = run::make_library(device, options.shaders);
    library_ = options.library;
    const gpu::MemoryBytes before = device.memory_ledger().now();
    const Clock::time_point start = Clock::now();
    executor_ = std::make_unique<run::Executor>(device, run.plan, scene, options);
    figures_.setup_ms = milliseconds_since(start);
    add_memory(before);
    figures_.value_bytes = executor_->value_bytes();
  }

  void first_frame(uint32_t frame) {
    const gpu::MemoryBytes before = device_->memory_ledger().now();
    const double shaders_before = library_->compile_milliseconds();
    const double pipelines_before = library_->pipelines().milliseconds();
    const Clock::time_point start = Clock::now();
    const run::FrameResult result = executor_->run_frame(frame);
    figures_.first_frame_ms = milliseconds_since(start);
    figures_.shaders_ms = library_->compile_milliseconds() - shaders_before;
    figures_.pipelines_ms = library_->pipelines().milliseconds() - pipelines_before;
    figures_.bound_names = executor_->bound_names();
    add_memory(before);
    for (const run::PassTime& time : result.once_times) figures_.once.emplace_back(time.pass, time.milliseconds);
    for (const run::PassTime& time : result.times) figures_.passes.push_back(time.pass);
    figures_.pass_ms.resize(figures_.passes.size());
  }

  void warm_up(uint32_t frame) { static_cast<void>(executor_->run_frame(frame, {.times = false})); }

  void free_running(uint32_t frame) {
    const Clock::time_point start = Clock::now();
    static_cast<void>(executor_->run_frame(frame, {.times = false}));
    figures_.frame_ms.push_back(milliseconds_since(start));
  }

  void one_by_one(uint32_t frame) {
    const run::FrameResult result = executor_->run_frame(frame);
    for (size_t pass = 0; pass < result.times.size(); ++pass)
      figures_.pass_ms[pass].push_back(result.times[pass].milliseconds);
  }

  BenchFigures take() {
    const bool timed = std::all_of(figures_.pass_ms.begin(), figures_.pass_ms.end(), [](const auto& times) {
      return std::all_of(times.begin(), times.end(), [](double time) { return time >= 0; });
    });
    if (!timed) figures_.pass_ms.clear();
    return std::move(figures_);
  }

 private:
  /// What was allocated since, and is still there.
  void add_memory(const gpu::MemoryBytes& before) {
    const gpu::MemoryBytes now = device_->memory_ledger().now();
    for (size_t i = 0; i < now.of.size(); ++i) figures_.memory.of[i] += now.of[i] - before.of[i];
  }

  gpu::Device* device_;
  std::shared_ptr<run::ShaderLibrary> library_;
  std::unique_ptr<run::Executor> executor_;
  BenchFigures figures_;
};

}  // namespace

std::vector<BenchFigures> measure(gpu::Device& device, const scene::Scene& scene, const std::vector<BenchRun>& runs,
                                  const BenchSettings& settings, const BenchCallback& on_frame) {
  std::vector<Measured> measured;
  for (const BenchRun& run : runs) measured.emplace_back(device, scene, run);
  const uint32_t total = settings.warm_up + settings.frames;
  uint32_t frame = settings.first_frame;
  for (uint32_t done = 0; done < total; ++done) {
    // Whoever goes second finds other caches and another clock: each goes first as often as the others.
    if (done > 0) std::reverse(measured.begin(), measured.end());
    for (Measured& run : measured) {
      if (done == 0)
        run.first_frame(frame);
      else if (done < settings.warm_up)
        run.warm_up(frame);
      else
        run.free_running(frame);
    }
    ++frame;
    if (done >= settings.warm_up) {
      for (Measured& run : measured) run.one_by_one(frame);
      ++frame;
    }
    if (on_frame) on_frame(done + 1, total);
  }
  if (total % 2 == 0) std::reverse(measured.begin(), measured.end());
  std::vector<BenchFigures> figures;
  for (Measured& run : measured) figures.push_back(run.take());
  return figures;
}

RayCounts count_rays(const run::FrameResult& frame) {
  RayCounts counts;
  for (const run::NamedImage& capture : frame.captures) {
    const size_t dot = capture.name.find('.');
    if (capture.name.substr(dot) != ".counts" || capture.image.desc.format != Format::rg32_uint) continue;
    counts.passes.push_back(capture.name.substr(0, dot));
    const double steps_before = counts.steps;
    const std::vector<std::byte>& texels = capture.image.texels;
    for (size_t at = 0; at + 8 <= texels.size(); at += 8) {
      uint32_t pixel[2];
      std::memcpy(pixel, texels.data() + at, sizeof(pixel));
      counts.rays += pixel[0];
      counts.steps += pixel[1];
    }
    counts.steps_by_pass.push_back(counts.steps - steps_before);
  }
  return counts;
}

}  // namespace lightloom::study
