#include <filesystem>
#include <memory>
#include <ostream>

#include "framework/base/atomic_file.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/commands.hpp"
#include "framework/cli/new_pass.hpp"
#include "framework/graph/graph_spec.hpp"

namespace lightloom::cli {
namespace {

namespace fs = std::filesystem;

struct NewPassOptions {
  std::string what;
  std::string name;
  fs::path out;
  bool compute = false;
};

std::string name_problem(std::string_view name, const PassRegistry& registry) {
  if (!is_name(name)) return "a name is lower-case letters, digits and '_', and begins with a letter";
  if (name == kComputeType || registry.find(name) != nullptr) return "there is a pass type of that name already";
  return {};
}

/// A folder of one's own is named as it is, one that is there must be empty: nothing is overwritten.
void require_free(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder) || !fs::is_empty(folder))
    throw Error(ExitCode::invalid_input, in_quotes(folder.string()) + " is there already and is no empty folder",
                "choose another by --out DIR");
}

/// All files or none: they are written beside the folder, which is then put in its place.
void write_files(const fs::path& folder, const std::vector<NewFile>& files) {
  const fs::path making = folder.parent_path() / ("." + folder.filename().string() + ".new");
  try {
    fs::remove_all(making);
    for (const NewFile& file : files) {
      fs::create_directories((making / file.name).parent_path());
      write_file_atomically(making / file.name, file.text);
    }
    fs::rename(making, folder);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(making, ignored);
    throw Error(ExitCode::run_failed,
                "the folder " + in_quotes(folder.string()) + " cannot be written: " + error.code().message());
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove_all(making, ignored);
    throw;
  }
}

/// Where the running program is installed; empty if it runs from a build folder.
fs::path installation() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path prefix = program.parent_path().parent_path();
  return fs::is_directory(prefix / "include" / "lightloom", ignored) ? prefix : fs::path();
}

void print_next(const NewPassOptions& options, const std::vector<NewFile>& files, std::ostream& out) {
  const std::string folder = options.out.generic_string();
  for (const NewFile& file : files) out << folder << "/" << file.name << "\n";
  std::string plugin;
  out << "next:\n";
  if (!options.compute) {
    const fs::path prefix = installation();
    out << "  cmake -S " << folder << " -B " << folder
        << "/build -DCMAKE_PREFIX_PATH=" << (prefix.empty() ? "PREFIX" : prefix.generic_string())
        << "\n  cmake --build " << folder << "/build\n";
    plugin = " --plugin " + folder + "/build/" + options.name + "_pass.so";
    if (prefix.empty()) out << "  (PREFIX is where 'cmake --install BUILD --prefix PREFIX' has put Lightloom)\n";
  }
  out << "  lightloom render " << folder << "/" << options.name << ".json" << plugin << " --scene SCENE --out out/"
      << options.name << "\n";
}

ExitCode make_pass(NewPassOptions options, const CommandContext& context) {
  if (const std::string problem = name_problem(options.name, context.registry); !problem.empty())
    throw Error(ExitCode::usage, in_quotes(options.name) + " cannot be the name of a new pass: " + problem);
  if (options.out.empty()) options.out = options.name;
  options.out = options.out.lexically_normal();
  if (options.out.filename().empty()) options.out = options.out.parent_path();  // "DIR/"
  require_free(options.out);
  const std::vector<NewFile> files = options.compute ? new_compute_files(options.name) : new_plugin_files(options.name);
  write_files(options.out, files);
  print_next(options, files, context.out);
  return ExitCode::done;
}

}  // namespace

void add_new_command(Command& program, const CommandContext& context) {
  Command& command = program.command("new", "Start a pass of one's own: write a skeleton that works as it is");
  command.description(
      "Writes a plug-in project (CMakeLists.txt, C++, a shader, a graph that uses it) or, with --compute, a GLSL "
      "shader "
      "and a graph in which a node of type 'compute' runs it. Nothing is overwritten.");
  auto options = std::make_shared<NewPassOptions>();
  command.positional("WHAT", options->what, "What to start").choices({"pass"}).required();
  command.positional("NAME", options->name, "Its name: lower-case letters, digits and '_'").required();
  command.flag("--compute", options->compute, "Only a shader and a graph, no C++");
  command.option("--out", options->out, "Folder to make; ./NAME unless given")
      .placeholder("DIR")
      .completes(Completion::files);
  command.action([options, &context] { return make_pass(*options, context); });
}

}  // namespace lightloom::cli
