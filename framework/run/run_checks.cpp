#include "framework/run/run_checks.hpp"

#include <utility>

namespace lightloom::run {

ExecutorOptions with_checks(ExecutorOptions options, const CheckOptions& checks) {
  if (checks.poison) options.poison = PoisonTone::nan;
  return options;
}

RunChecks::RunChecks(const CheckOptions& checks, gpu::Device& device, const Plan& plan, const scene::Scene& scene,
                     const ExecutorOptions& options)
    : checks_(checks), plan_(plan) {
  if (checks.find_nan || checks.stop_at_nan) watch_.emplace(plan_);
  if (!checks.poison) return;
  poison_.emplace(plan_);
  ExecutorOptions other = options;
  other.poison = PoisonTone::number;
  twin_.emplace(device, plan_, scene, other);
}

void RunChecks::resume(const ExecutorState& state) {
  if (watch_) watch_->resume(state);
  if (twin_) twin_->restore(state);
}

void RunChecks::add(const FrameResult& result) {
  if (watch_) watch_->add(result.frame, result.scanned);
  if (!poison_) return;
  const FrameResult other = twin_->run_frame(result.frame, {.outputs = false, .captures = false});
  poison_->add(result.frame, result.scanned, other.scanned);
}

std::vector<std::string> RunChecks::warnings() const {
  std::vector<std::string> sentences;
  if (watch_) sentences = watch_->warnings();
  if (poison_)
    for (std::string& complaint : poison_->complaints()) sentences.push_back(std::move(complaint));
  return sentences;
}

std::vector<std::string> RunChecks::failures() const {
  std::vector<std::string> sentences;
  if (stop()) sentences.push_back("ended at the first NaN or infinity: " + watch_->found().front().value);
  if (poison_ && !poison_->found().empty())
    sentences.push_back("the pictures depend on what nobody wrote, or may: " + poison_->found().front().value);
  return sentences;
}

void RunChecks::add_to(nlohmann::ordered_json& record) const {
  if (watch_) record["non_finite"] = watch_->record();
  if (poison_) record["unwritten"] = poison_->record();
}

}  // namespace lightloom::run
