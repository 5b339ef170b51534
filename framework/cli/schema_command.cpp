#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "framework/base/atomic_file.hpp"
#include "framework/cli/commands.hpp"
#include "framework/graph/graph_schema.hpp"
#include "framework/graph/plan_json.hpp"
#include "framework/scene/scene.hpp"
#include "framework/scene/scene_schema.hpp"
#include "framework/study/study_schema.hpp"

namespace lightloom::cli {
namespace {

struct SchemaOptions {
  std::string format;
  std::filesystem::path out;
};

nlohmann::ordered_json schema_of(const std::string& format, const PassRegistry& registry) {
  if (format == "scene") return scene::scene_schema();
  if (format == "study") return study::study_schema();
  if (format == "plan") return plan_schema();
  std::vector<std::string> features;
  for (const auto& [name, present] : scene::Features{}.named()) features.push_back(name);
  return graph_schema(registry, features);
}

ExitCode print(const SchemaOptions& options, const CommandContext& context) {
  const std::string text = schema_of(options.format, context.registry).dump(2) + "\n";
  if (options.out.empty())
    context.out << text;
  else
    write_file_atomically(options.out, text);
  return ExitCode::done;
}

}  // namespace

void add_schema_command(Command& program, const CommandContext& context) {
  Command& command = program.command("schema", "Print the JSON Schema of graph, scene or study files, or of plans");
  command.description(
      "Prints a JSON Schema (2020-12) by which an editor completes, explains and checks files as they are written. "
      "That of graphs has all pass types, those of plug-ins included. That of plans is for programs that read `plan "
      "--format json`.");
  auto options = std::make_shared<SchemaOptions>();
  command.positional("FORMAT", options->format, "What files to describe")
      .choices({"graph", "scene", "study", "plan"})
      .required();
  command.option("--out", options->out, "Write it to a file").placeholder("FILE").completes(Completion::files);
  command.action([options, &context] { return print(*options, context); });
}

}  // namespace lightloom::cli
