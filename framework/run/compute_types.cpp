#include "framework/run/compute_types.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
#include "framework/gpu/includes.hpp"
#include "framework/gpu/pipeline.hpp"
#include "framework/gpu/shader_compiler.hpp"
#include "framework/run/compute_type.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

/// Where shaders of a graph are looked for: beside its file, then where all others are.
std::vector<fs::path> search_folders(const GraphSpec& spec, const ShaderFolders& shaders) {
  std::vector<fs::path> folders = {fs::absolute(spec.file).parent_path()};
  folders.insert(folders.end(), shaders.sources.begin(), shaders.sources.end());
  return folders;
}

/// The type of the bundle that each input is connected to, where it is one.
std::map<std::string, std::string> connected_bundles(const GraphSpec& spec, const PassSpec& pass,
                                                     const PassRegistry& registry) {
  std::map<std::string, std::string> bundles;
  for (const ConnectionSpec& connection : pass.inputs) {
    const auto source = std::find_if(spec.passes.begin(), spec.passes.end(),
                                     [&](const PassSpec& other) { return other.name == connection.edge.pass; });
    if (source == spec.passes.end() || !connection.edge.part.empty()) continue;
    const PassType* type = registry.find(source->type.text);
    const Port* port = type == nullptr ? nullptr : type->find_port(connection.edge.port, Direction::out);
    if (port != nullptr && !port->bundle.empty()) bundles[connection.name] = port->bundle;
  }
  return bundles;
}

/// Makes the types of one graph; each shader is compiled once.
class TypeMaker {
 public:
  TypeMaker(GraphSpec& spec, const PassRegistry& registry, const ShaderFolders& shaders, Diagnostics& diagnostics,
            FileContents* files_read)
      : spec_(spec),
        registry_(registry),
        folders_(search_folders(spec, shaders)),
        compiler_({.include_directories = shaders.sources, .cache_directory = shaders.cache}),
        diagnostics_(diagnostics),
        files_read_(files_read) {}

  void run() {
    for (PassSpec& pass : spec_.passes)
      if (pass.compute && !pass.compute->shader.text.empty()) make(pass);
  }

 private:
  void make(PassSpec& pass) {
    const TextSpec& written = pass.compute->shader;
    try {
      const ComputeShader shader = compile(written.text);
      std::optional<PassType> type =
          make_compute_type({pass, spec_.params, connected_bundles(spec_, pass, registry_)}, shader, diagnostics_);
      note_compiled();
      if (!type) return;
      // The rules for tables of pass types hold for it as well.
      PassRegistry().add(*type);
      pass.own_type = std::make_shared<const PassType>(std::move(*type));
    } catch (const Error& error) {
      note_compiled();
      diagnostics_.error("shader-error", written.where, "pass '" + pass.name + "': " + error.what(), error.hint());
    }
  }

  /// Before it is read, so that a change in between is taken for one.
  void note_search(const std::string& name) {
    if (files_read_ == nullptr) return;
    for (const fs::path& folder : folders_) {
      const std::optional<uint64_t> contents = content_of(folder / name);
      files_read_->insert_or_assign(folder / name, contents);
      if (contents) return;
    }
  }

  void note_compiled() {
    if (files_read_ != nullptr) files_read_->insert(compiler_.files_read().begin(), compiler_.files_read().end());
  }

  ComputeShader compile(const std::string& name) {
    note_search(name);
    const fs::path file = gpu::find_file(name, folders_);
    if (file.empty()) {
      std::vector<std::string> searched;
      for (const fs::path& folder : folders_) searched.push_back(in_quotes(folder.string()));
      throw Error(ExitCode::invalid_input, "there is no shader " + in_quotes(name),
                  "searched in " + join(searched, ", "));
    }
    if (file.extension() != ".comp")
      throw Error(ExitCode::invalid_input, "shader " + in_quotes(name) + " is no compute shader",
                  "its name must end with .comp");
    const std::vector<std::string> files = {fs::absolute(file).lexically_normal().string()};
    const auto place = [this, files](std::string_view declared) { return compiler_.declaration(files, declared); };
    const auto known = programs_.find(files.front());
    if (known != programs_.end()) return {files.front(), known->second.reflection, known->second.identity, place};
    const gpu::ShaderProgram program = gpu::make_program(compiler_.compile_files(files));
    programs_.emplace(files.front(), program);
    return {files.front(), program.reflection, program.identity, place};
  }

  GraphSpec& spec_;
  const PassRegistry& registry_;
  std::vector<fs::path> folders_;
  gpu::ShaderCompiler compiler_;
  Diagnostics& diagnostics_;
  FileContents* files_read_;
  std::map<std::string, gpu::ShaderProgram> programs_;
};

bool has_compute_passes(const GraphSpec& spec) {
  return std::any_of(spec.passes.begin(), spec.passes.end(),
                     [](const PassSpec& pass) { return pass.compute.has_value(); });
}

}  // namespace

void make_compute_types(GraphSpec& spec, const PassRegistry& registry, const ShaderFolders& shaders,
                        Diagnostics& diagnostics, FileContents* files_read) {
  if (has_compute_passes(spec)) TypeMaker(spec, registry, shaders, diagnostics, files_read).run();
}

std::optional<GraphSpec> parse_graph_text(const std::string& text, const fs::path& file, const PassRegistry& registry,
                                          const std::optional<ShaderFolders>& shaders, Diagnostics& diagnostics,
                                          FileContents* files_read) {
  std::optional<GraphSpec> spec = parse_graph(text, file.string(), diagnostics);
  if (spec && has_compute_passes(*spec))
    make_compute_types(*spec, registry, shaders ? *shaders : default_shader_folders(), diagnostics, files_read);
  return spec;
}

std::optional<GraphSpec> read_graph(const fs::path& file, const PassRegistry& registry,
                                    const std::optional<ShaderFolders>& shaders, Diagnostics& diagnostics) {
  return parse_graph_text(read_text_file(file), file, registry, shaders, diagnostics);
}

}  // namespace lightloom::run
