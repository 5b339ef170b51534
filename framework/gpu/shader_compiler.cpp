#include "framework/gpu/shader_compiler.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
#include "framework/gpu/declaration.hpp"
#include "framework/gpu/glslang_compile.hpp"
#include "framework/gpu/includes.hpp"
#include "framework/gpu/spirv_cache.hpp"

namespace lightloom::gpu {
namespace {

Stage stage_of(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".vert") return Stage::vertex;
  if (extension == ".frag") return Stage::fragment;
  if (extension == ".comp") return Stage::compute;
  throw Error(ExitCode::invalid_input, "shader " + in_quotes(file) + " has no known stage",
              "name it *.comp, *.vert or *.frag");
}

/// A file that is named by its whole path is shown as seen from the working folder.
std::string shown_name(const std::filesystem::path& file) {
  if (!file.is_absolute()) return file.string();
  std::error_code failed;
  const std::filesystem::path seen = std::filesystem::relative(file, failed);
  return failed || seen.empty() || *seen.begin() == ".." ? file.string() : seen.string();
}

/// What shaders named by their whole paths include may lie beside them.
std::vector<std::filesystem::path> folders_for(std::span<const std::string> files,
                                               std::vector<std::filesystem::path> folders) {
  for (const std::filesystem::path file : files)
    if (file.is_absolute()) folders.insert(folders.begin(), file.parent_path());
  return folders;
}

ShaderSource load_shader(const std::string& file, std::span<const std::filesystem::path> directories,
                         FileContents& files) {
  const Stage stage = stage_of(file);
  const std::filesystem::path path = find_file(file, directories);
  if (!path.empty()) {
    ShaderSource source{.name = shown_name(file), .text = read_text_file(path, kMostShaderBytes), .stage = stage};
    note_file(file, directories, source.text, files);
    return source;
  }
  note_file(file, directories, std::nullopt, files);
  for (const auto& directory : directories) {
    std::error_code ignored;
    if (std::filesystem::exists(directory / file, ignored))
      throw Error(ExitCode::invalid_input, "shader " + in_quotes((directory / file).string()) + " is no regular file");
  }
  std::vector<std::string> searched;
  for (const auto& directory : directories) searched.push_back(in_quotes(directory.string()));
  throw Error(ExitCode::invalid_input, "there is no shader " + in_quotes(file),
              searched.empty() ? "no shader folder is known" : "searched in " + join(searched, ", "));
}

void require_one_pipeline(std::span<const ShaderSource> stages) {
  const bool compute = stages.size() == 1 && stages[0].stage == Stage::compute;
  const bool graphics = stages.size() == 2 && stages[0].stage == Stage::vertex && stages[1].stage == Stage::fragment;
  if (compute || graphics) return;
  throw Error(ExitCode::invalid_input,
              "a pipeline has one compute shader, or a vertex and a fragment shader in this order");
}

}  // namespace

std::string to_string(Stage stage) {
  switch (stage) {
    case Stage::vertex:
      return "vertex";
    case Stage::fragment:
      return "fragment";
    case Stage::compute:
      break;
  }
  return "compute";
}

ShaderCompiler::ShaderCompiler(ShaderCompilerOptions options) : options_(std::move(options)) {}

std::vector<SpirvModule> ShaderCompiler::compile(std::span<const ShaderSource> stages, const ShaderDefines& defines) {
  files_read_.clear();
  return compile_with(stages, defines, options_.include_directories);
}

std::vector<SpirvModule> ShaderCompiler::compile_with(std::span<const ShaderSource> stages,
                                                      const ShaderDefines& defines,
                                                      std::span<const std::filesystem::path> folders) {
  require_one_pipeline(stages);
  const IncludeTexts includes = collect_includes(stages, folders, files_read_);
  const CacheKey key = cache_key(stages, defines, includes, compiler_identity());
  if (!options_.cache_directory.empty()) {
    CacheLookup lookup = read_cache(options_.cache_directory, key, stages);
    if (lookup.damaged) ++statistics_.rejected_cache_entries;
    if (lookup.modules) {
      ++statistics_.from_cache;
      return std::move(*lookup.modules);
    }
  }
  std::vector<SpirvModule> modules = compile_glsl(stages, defines, includes, folders);
  ++statistics_.compiled;
  if (!options_.cache_directory.empty()) {
    try {
      write_cache(options_.cache_directory, key, modules);
    } catch (const Error& error) {
      // The shaders are good; only the next start will be slower.
      statistics_.cache_write_failure = error.what();
    }
  }
  return modules;
}

std::vector<SpirvModule> ShaderCompiler::compile_files(std::span<const std::string> files,
                                                       const ShaderDefines& defines) {
  files_read_.clear();
  const std::vector<std::filesystem::path> folders = folders_for(files, options_.include_directories);
  std::vector<ShaderSource> sources;
  for (const std::string& file : files) sources.push_back(load_shader(file, folders, files_read_));
  return compile_with(sources, defines, folders);
}

std::string ShaderCompiler::declaration(std::span<const std::string> files, std::string_view name) const {
  const std::vector<std::filesystem::path> folders = folders_for(files, options_.include_directories);
  FileContents ignored;
  std::vector<ShaderSource> sources;
  for (const std::string& file : files) sources.push_back(load_shader(file, folders, ignored));
  for (const ShaderSource& source : sources)
    if (const auto line = declaration_line(source.text, name)) return source.name + ":" + std::to_string(*line);
  for (const auto& [file, text] : collect_includes(sources, folders, ignored))
    if (const auto line = declaration_line(text, name)) return file + ":" + std::to_string(*line);
  std::vector<std::string> names;
  for (const ShaderSource& source : sources) names.push_back(source.name);
  return join(names, " + ");
}

}  // namespace lightloom::gpu
