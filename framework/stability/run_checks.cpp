#include "framework/stability/run_checks.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

#include "framework/base/error.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/base/text.hpp"

namespace lightloom::stability {

bool passed(const Outcome& outcome) {
  return outcome.failure.empty() && !outcome.figures.empty() &&
         std::all_of(outcome.figures.begin(), outcome.figures.end(), holds);
}

Outcome run_check(const Check& check, Lab& lab) {
  Outcome outcome{.check = &check, .figures = {}, .failure = {}};
  const auto begin = std::chrono::steady_clock::now();
  lab.device().clear_validation_messages();
  try {
    stop_if_interrupted();
    outcome.figures = check.measure(lab);
    if (outcome.figures.empty()) outcome.failure = "measured nothing";
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  for (const gpu::ValidationMessage& message : lab.device().validation_messages())
    outcome.failure += (outcome.failure.empty() ? "" : "\n") + ("validation: " + message.text);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  outcome.seconds = elapsed.count();
  return outcome;
}

std::vector<const Check*> choose_checks(std::span<const Check> checks, const std::vector<std::string>& globs,
                                        bool slow) {
  std::vector<std::string> names;
  for (const Check& check : checks) names.push_back(check.name);
  for (const std::string& glob : globs) {
    const bool fits = std::any_of(checks.begin(), checks.end(), [&](const Check& check) {
      return glob_match(glob, check.name) || glob_match(glob, check.group);
    });
    if (!fits)
      throw Error(ExitCode::usage, "no stability check or group of them is called " + in_quotes(glob),
                  did_you_mean(glob, names, "there are"));
  }
  std::vector<const Check*> chosen;
  for (const Check& check : checks) {
    const bool named = std::find(globs.begin(), globs.end(), check.name) != globs.end();
    const bool meant = globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& glob) {
                         return glob_match(glob, check.name) || glob_match(glob, check.group);
                       });
    if (named || (meant && (slow || !check.slow))) chosen.push_back(&check);
  }
  return chosen;
}

}  // namespace lightloom::stability
