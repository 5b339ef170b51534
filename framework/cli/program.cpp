#include "framework/cli/program.hpp"

#include <exception>
#include <ostream>

#include "framework/base/interrupt.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/messages.hpp"
#include "framework/run/version.hpp"

namespace lightloom::cli {
namespace {

constexpr std::string_view kEpilog =
    R"(Exit codes: 0 done, 1 run failed, 2 wrong usage, 3 invalid graph or scene, 4 no usable device,
128 + N interrupted by signal N (130 for Ctrl-C).

Examples:
  lightloom render graphs/paper.json --scene samples/scenes/atrium.scene.json --out out/atrium
  lightloom check graphs/paper.json
  lightloom passes voxel_path_trace
  lightloom study samples/studies/ablation.json --out out/ablation
  source <(lightloom completion bash))";

ExitCode answer(const ParseResult& result, const CommandContext& context) {
  switch (result.kind) {
    case ParseResult::Kind::help:
      context.out << result.command->help();
      return ExitCode::done;
    case ParseResult::Kind::version:
      context.out << result.command->version_text() << '\n';
      return ExitCode::done;
    case ParseResult::Kind::problems:
      for (const Problem& problem : result.problems) print_error(context.err, problem.message, problem.hint);
      return ExitCode::usage;
    case ParseResult::Kind::run:
      break;
  }
  return result.command->run();
}

}  // namespace

ExitCode run_program(const std::vector<std::string>& arguments, const CommandContext& context) {
  try {
    Command program("lightloom", "Declarative render graphs with pluggable global illumination.");
    program.version("lightloom " + run::version() + " (commit " + run::commit() + ")").epilog(std::string(kEpilog));
    // main takes these out before; what is left of them is a mistake that the parser reports.
    std::vector<std::string> plugins;
    program
        .option("--plugin", plugins,
                "Load a plug-in with pass types of one's own, before any command; also $LIGHTLOOM_PLUGINS, by ':'")
        .placeholder("FILE");
    add_render_command(program, context, arguments);
    add_replay_command(program, context, arguments);
    add_probe_command(program, context);
    add_check_command(program, context);
    add_plan_command(program, context);
    add_passes_command(program, context);
    add_schema_command(program, context);
    add_scene_command(program, context);
    add_brdf_command(program, context);
    add_compare_command(program, context);
    add_study_command(program, context);
    add_stability_command(program, context);
    add_new_command(program, context);
    add_bench_command(program, context, arguments);
    add_devices_command(program, context);
    add_completion_command(program, context);
    const ExitCode code = answer(program.parse(arguments), context);
    context.out.flush();
    if (!context.out) throw Error(ExitCode::run_failed, "the result cannot be written to standard output");
    return code;
  } catch (const Error& error) {
    print_error(context.err, error.what(), error.hint());
    return error.code();
  } catch (const Interrupted& interrupted) {
    print_error(context.err, "interrupted by " + signal_name(interrupted.signal()), "");
    return interrupted_code(interrupted.signal());
  } catch (const std::bad_alloc&) {
    print_error(context.err, "there is not enough memory", "a smaller --size or --set resolution=N needs less");
  } catch (const std::exception& error) {
    print_error(context.err, std::string("unexpected failure: ") + error.what(), "");
  }
  return ExitCode::run_failed;
}

}  // namespace lightloom::cli
