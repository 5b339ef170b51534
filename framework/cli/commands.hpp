#pragma once

#include <string>
#include <vector>

#include "framework/cli/program.hpp"

namespace lightloom::cli {

// Each adds one command with its options and its action; `context` must outlive the program.

/// `arguments` is the whole command line, for the record of the run.
void add_render_command(Command& program, const CommandContext& context, const std::vector<std::string>& arguments);
/// Likewise.
void add_replay_command(Command& program, const CommandContext& context, const std::vector<std::string>& arguments);
void add_probe_command(Command& program, const CommandContext& context);
void add_check_command(Command& program, const CommandContext& context);
void add_plan_command(Command& program, const CommandContext& context);
void add_passes_command(Command& program, const CommandContext& context);
void add_schema_command(Command& program, const CommandContext& context);
void add_scene_command(Command& program, const CommandContext& context);
void add_brdf_command(Command& program, const CommandContext& context);
void add_compare_command(Command& program, const CommandContext& context);
void add_study_command(Command& program, const CommandContext& context);
void add_stability_command(Command& program, const CommandContext& context);
void add_new_command(Command& program, const CommandContext& context);
/// `arguments` as above.
void add_bench_command(Command& program, const CommandContext& context, const std::vector<std::string>& arguments);
void add_devices_command(Command& program, const CommandContext& context);
void add_completion_command(Command& program, const CommandContext& context);

}  // namespace lightloom::cli
