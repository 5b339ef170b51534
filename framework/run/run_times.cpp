#include "framework/run/run_times.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"

namespace lightloom::run {

RunTimes read_run_times(const std::filesystem::path& folder, const Plan& plan) {
  const std::filesystem::path file = folder / "run.json";
  const nlohmann::json record = nlohmann::json::parse(read_text_file(file), nullptr, false);
  const std::string in_file = "'" + file.string() + "' ";
  if (!record.is_object() || !record.contains("passes") || !record["passes"].is_array())
    throw Error(ExitCode::invalid_input, in_file + "is no record of a run", "name the folder of a finished render");
  std::map<std::string, double> times;
  for (const nlohmann::json& pass : record["passes"])
    if (pass.is_object() && pass.contains("pass") && pass["pass"].is_string() && pass.contains("median_ms") &&
        pass["median_ms"].is_number() && pass["median_ms"] >= 0)
      times[pass["pass"]] = pass["median_ms"];
  RunTimes result;
  for (const PlanStep& step : plan.steps) {
    const std::string& name = plan.graph.passes[step.pass].name;
    const auto time = times.find(name);
    if (time == times.end())
      throw Error(ExitCode::invalid_input, in_file + "has no time of pass '" + name + "', which this plan runs",
                  "plan the same graph with the same scene and options as the run");
    result.step_ms.push_back(time->second);
  }
  const nlohmann::json hash = record.value(nlohmann::json::json_pointer("/graph/plan_hash"), nlohmann::json());
  result.same_plan = hash == hex(plan_hash(plan));
  return result;
}

}  // namespace lightloom::run
