#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "framework/cli/cache_option.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/cli/messages.hpp"
#include "framework/cli/scene_option.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/compute_types.hpp"
#include "framework/run/plugins.hpp"

namespace lightloom::cli {
namespace {

struct CheckOptions {
  std::vector<std::filesystem::path> graphs;
  std::filesystem::path scene;
  LimitOptions limits;
  CacheOption cache;
  bool json = false;
};

bool same(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && a.where == b.where && a.message == b.message;
}

/// Adds what is not there yet: a variant meets most problems of the graph again.
void merge(const Diagnostics& from, Diagnostics& into) {
  for (const Diagnostic& found : from.all()) {
    const auto known = [&found](const Diagnostic& other) { return same(found, other); };
    if (std::any_of(into.all().begin(), into.all().end(), known)) continue;
    if (found.severity == Severity::error) {
      into.error(found.code, found.where, found.message, found.hint);
    } else {
      into.warning(found.code, found.where, found.message, found.hint);
    }
  }
}

/// The graph as it stands, and with each of its variants.
Diagnostics check_graph(const std::filesystem::path& file, const scene::Scene* scene, const CacheOption& cache,
                        const CommandContext& context) {
  const PassRegistry& registry = context.registry;
  Diagnostics diagnostics;
  std::optional<GraphSpec> spec;
  try {
    spec = run::read_graph(file, registry, cache.apply_to(run::shader_folders_with(context.plugins)), diagnostics);
  } catch (const Error& error) {
    diagnostics.error("unreadable-file", {file.string(), 0, 0}, error.what(), error.hint());
    return diagnostics;
  }
  if (!spec) return diagnostics;
  const LinkEnvironment environment = run::link_environment(scene);
  (void)link(*spec, registry, {}, environment, diagnostics);
  for (const VariantSpec& variant : spec->variants) {
    Diagnostics of_variant;
    LinkOptions options;
    options.variants = {variant.name};
    (void)link(*spec, registry, options, environment, of_variant);
    merge(of_variant, diagnostics);
  }
  return diagnostics;
}

nlohmann::ordered_json to_json(const Diagnostics& diagnostics) {
  nlohmann::ordered_json problems = nlohmann::ordered_json::array();
  for (const Diagnostic& diagnostic : diagnostics.sorted()) {
    problems.push_back({{"code", diagnostic.code},
                        {"severity", diagnostic.severity == Severity::error ? "error" : "warning"},
                        {"file", diagnostic.where.file},
                        {"line", diagnostic.where.line},
                        {"column", diagnostic.where.column},
                        {"message", diagnostic.message},
                        {"hint", diagnostic.hint}});
  }
  return problems;
}

ExitCode check(const CheckOptions& options, const CommandContext& context) {
  const std::optional<scene::Scene> scene =
      load_optional_scene(options.scene, options.limits.load_options(), context.err);
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  ExitCode code = ExitCode::done;
  for (const std::filesystem::path& file : options.graphs) {
    const Diagnostics diagnostics = check_graph(file, scene ? &*scene : nullptr, options.cache, context);
    if (diagnostics.has_errors()) code = ExitCode::invalid_input;
    files.push_back({{"file", file.string()}, {"ok", !diagnostics.has_errors()}, {"problems", to_json(diagnostics)}});
    if (options.json) continue;
    print_diagnostics(context.out, diagnostics);
    if (diagnostics.all().empty()) context.out << file.string() << ": no problems\n";
  }
  if (options.json) context.out << nlohmann::ordered_json{{"files", files}}.dump(2) << '\n';
  return code;
}

}  // namespace

void add_check_command(Command& program, const CommandContext& context) {
  Command& command = program.command("check", "List every problem of graph files, with line and column");
  command.description(
      "Checks each graph as it stands and with each of its variants. Exits with 3 if any has an error.");
  auto options = std::make_shared<CheckOptions>();
  command.positional("GRAPH", options->graphs, "Graph files (JSON)").required();
  command.option("--scene", options->scene,
                 "Scene to check against; a unit cube with every scene feature unless given");
  command.flag("--json", options->json, "Print JSON");
  options->limits.add_to(command);
  options->cache.add_to(command);
  command.action([options, &context] { return check(*options, context); });
}

}  // namespace lightloom::cli
