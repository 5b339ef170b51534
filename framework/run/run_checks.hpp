#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/check_options.hpp"
#include "framework/run/executor.hpp"
#include "framework/run/non_finite.hpp"
#include "framework/run/poison_check.hpp"

namespace lightloom::run {

/// What the render's own executor is told for them.
[[nodiscard]] ExecutorOptions with_checks(ExecutorOptions options, const CheckOptions& checks);

/// The checks of one render, frame by frame. The plan must have scans if any is wanted (CompileOptions::scan).
class RunChecks {
 public:
  /// A render of `plan` with `options`; for the poison a second executor is to run beside it, on the same device.
  RunChecks(const CheckOptions& checks, gpu::Device& device, const Plan& plan, const scene::Scene& scene,
            const ExecutorOptions& options);

  /// What a resumed run starts from.
  void resume(const ExecutorState& state);
  /// Looks at a frame that the render's executor has run.
  void add(const FrameResult& result);
  /// Is the render to end here?
  [[nodiscard]] bool stop() const { return checks_.stop_at_nan && watch_ && !watch_->found().empty(); }

  [[nodiscard]] std::vector<std::string> warnings() const;
  /// Why the render counts as failed, a sentence each.
  [[nodiscard]] std::vector<std::string> failures() const;
  /// Adds `non_finite` and `unwritten` to the record of the run, where they were looked for.
  void add_to(nlohmann::ordered_json& record) const;

 private:
  CheckOptions checks_;
  Plan plan_;
  std::optional<NonFiniteWatch> watch_;
  std::optional<PoisonCheck> poison_;
  std::optional<Executor> twin_;  ///< the same with the other poison
};

}  // namespace lightloom::run
