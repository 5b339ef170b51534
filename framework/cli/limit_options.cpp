#include "framework/cli/limit_options.hpp"

namespace lightloom::cli {
namespace {

constexpr const char* kGroup = "Input files";

std::string check_limit(std::string_view text) {
  Assignment limit;
  if (std::string problem = parse_value(text, limit); !problem.empty()) return problem;
  Limits ignored;
  return set_limit(ignored, limit.name, limit.value);
}

}  // namespace

void LimitOptions::add_limits_to(Command& command) {
  command
      .option("--limit", limits,
              "Raise or lower what an input file may ask for; docs/hostile_input.md lists the limits")
      .check(check_limit)
      .group(kGroup);
}

void LimitOptions::add_to(Command& command) {
  add_limits_to(command);
  command
      .flag("--allow-outside", allow_outside,
            "Let glTF files name files outside of their folder and that of the main file")
      .group(kGroup);
}

scene::LoadOptions LimitOptions::load_options() const {
  scene::LoadOptions options{.limits = {}, .allow_outside = allow_outside};
  for (const Assignment& limit : limits) static_cast<void>(set_limit(options.limits, limit.name, limit.value));
  return options;
}

}  // namespace lightloom::cli
