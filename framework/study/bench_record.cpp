#include "framework/study/bench_record.hpp"

#include <algorithm>

#include "framework/base/hash.hpp"
#include "framework/run/provenance.hpp"
#include "framework/run/version.hpp"

namespace lightloom::study {
namespace {

using Json = nlohmann::ordered_json;

Json timing_json(const std::vector<double>& milliseconds) {
  const Timing timing = timing_of(milliseconds);
  return {{"median", timing.median}, {"p95", timing.p95}, {"samples", milliseconds}};
}

Json memory_json(const gpu::MemoryBytes& bytes, uint64_t total) {
  Json json = {{"total", total}};
  for (size_t i = 0; i < bytes.of.size(); ++i)
    json[std::string(gpu::to_string(static_cast<gpu::MemoryPurpose>(i)))] = bytes.of[i];
  return json;
}

Json rays_json(const BenchFigures& figures) {
  if (!figures.rays) return nullptr;
  return {{"passes", figures.rays->passes},
          {"rays_per_frame", figures.rays->rays},
          {"steps_per_frame", figures.rays->steps},
          {"rays_per_second", per_second(figures.rays->rays, figures)},
          {"steps_per_second", per_second(figures.rays->steps, figures)}};
}

Json run_json(const BenchFigures& figures, const Plan& plan) {
  Json once = {{"plan_ms", figures.plan_ms},
               {"setup_ms", figures.setup_ms},
               {"first_frame_ms", figures.first_frame_ms},
               {"shaders_ms", figures.shaders_ms},
               {"pipelines_ms", figures.pipelines_ms},
               {"hoisted", Json::object()}};
  for (const auto& [pass, milliseconds] : figures.once) once["hoisted"][pass] = milliseconds;
  Json passes = Json::object();
  for (size_t pass = 0; pass < figures.pass_ms.size(); ++pass)
    passes[figures.passes[pass]] = timing_json(figures.pass_ms[pass]);
  return {{"name", figures.name},
          {"graph", plan.graph.name},
          {"plan_hash", hex(plan_hash(plan))},
          {"view", to_string(plan.graph.view)},
          {"trace", to_string(plan.graph.trace)},
          {"frame_ms", timing_json(figures.frame_ms)},
          {"sum_of_passes_ms", timing_json(sums_of_passes(figures))},
          {"passes", std::move(passes)},
          {"once", std::move(once)},
          {"value_memory_bytes", figures.value_bytes},
          {"device_bytes", memory_json(figures.memory, figures.memory.total())},
          {"rays", rays_json(figures)}};
}

Json ratio_json(const RatioEstimate& ratio) {
  return {{"ratio", ratio.median},
          {"low", ratio.low},
          {"high", ratio.high},
          {"pairs", ratio.pairs},
          {"within_noise", ratio.within_noise}};
}

Json comparison_json(const BenchComparison& comparison) {
  Json passes = Json::object();
  for (const auto& [pass, ratio] : comparison.passes) passes[pass] = ratio_json(ratio);
  return {{"frame", ratio_json(comparison.frame)}, {"passes", std::move(passes)}};
}

}  // namespace

BenchComparison compare_runs(const BenchFigures& first, const BenchFigures& second) {
  BenchComparison comparison{paired_ratio(first.frame_ms, second.frame_ms), {}};
  for (size_t pass = 0; pass < first.pass_ms.size(); ++pass) {
    const auto same = std::find(second.passes.begin(), second.passes.end(), first.passes[pass]);
    if (same == second.passes.end() || second.pass_ms.empty()) continue;
    const auto& other = second.pass_ms[static_cast<size_t>(same - second.passes.begin())];
    comparison.passes.emplace_back(first.passes[pass], paired_ratio(first.pass_ms[pass], other));
  }
  return comparison;
}

std::vector<double> sums_of_passes(const BenchFigures& figures) {
  std::vector<double> sums;
  for (const std::vector<double>& times : figures.pass_ms) {
    sums.resize(std::max(sums.size(), times.size()));
    for (size_t frame = 0; frame < times.size(); ++frame) sums[frame] += times[frame];
  }
  return sums;
}

double per_second(double count, const BenchFigures& figures) {
  if (!figures.rays || figures.pass_ms.empty()) return 0;
  double milliseconds = 0;
  for (const std::string& pass : figures.rays->passes) {
    const auto found = std::find(figures.passes.begin(), figures.passes.end(), pass);
    if (found == figures.passes.end()) return 0;
    milliseconds += percentile(figures.pass_ms[static_cast<size_t>(found - figures.passes.begin())], 0.5);
  }
  return milliseconds > 0 ? count / milliseconds * 1e3 : 0;
}

Json bench_json(const BenchRecord& record, const scene::Scene& scene) {
  Json json = {{"lightloom", run::version()},
               {"commit", run::commit()},
               {"command_line", record.command_line},
               {"device", run::device_record(record.device)},
               {"scene", run::scene_record(scene)},
               {"first_frame", record.settings.first_frame},
               {"frames", record.settings.frames},
               {"warm_up", record.settings.warm_up},
               {"scene_ms", record.scene_ms},
               {"device_ms", record.device_ms},
               {"host_bytes", record.memory.host},
               {"host_peak_bytes", record.memory.host_peak},
               {"device_peak_bytes", memory_json(record.memory.device_peak, record.memory.device_peak_total)}};
  if (record.rates) json["device_rates"] = rates_json(*record.rates);
  const auto run = [&](size_t index) {
    Json figures = run_json(record.runs[index], record.plans[index]);
    if (index < record.floors.size()) figures["floors"] = floors_json(record.floors[index]);
    return figures;
  };
  json.update(run(0));
  if (record.runs.size() < 2) return json;
  json["against"] = run(1);
  json["comparison"] = comparison_json(compare_runs(record.runs[0], record.runs[1]));
  return json;
}

}  // namespace lightloom::study
