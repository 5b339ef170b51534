#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/file_watch.hpp"
#include "framework/gpu/pipeline.hpp"
#include "framework/gpu/shader_compiler.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::run {

/// Compiled shader programs by file names, and their pipelines.
class ShaderLibrary {
 public:
  /// Pipelines are kept on disk in the folder of the shader cache.
  ShaderLibrary(const gpu::Device& device, const gpu::ShaderCompilerOptions& options)
      : compiler_(options), pipelines_(device, options.cache_directory) {}
  const gpu::ShaderProgram& program(const std::vector<std::string>& files);
  /// Where a program's shaders declare a name of their interface: "file:line".
  [[nodiscard]] std::string declaration(const std::vector<std::string>& files, std::string_view name) const {
    return compiler_.declaration(files, name);
  }
  /// What reading and compiling programs took so far.
  [[nodiscard]] double compile_milliseconds() const { return compile_milliseconds_; }
  [[nodiscard]] gpu::PipelineCache& pipelines() { return pipelines_; }

  /// What was read for the programs that it has, and for those that did not compile since the last `forget`.
  [[nodiscard]] FileContents files_read() const;
  /// Drops the programs made of these files, so that they are compiled anew when next asked for. Pipelines stay: they
  /// are told apart by SPIR-V.
  void forget(const std::vector<std::filesystem::path>& changed);
  /// Drops the programs that nobody asked for since the last call.
  void drop_unused();

 private:
  struct Entry {
    gpu::ShaderProgram program;
    FileContents read;
    bool used = true;
  };
  gpu::ShaderCompiler compiler_;
  gpu::PipelineCache pipelines_;
  double compile_milliseconds_ = 0;
  std::map<std::vector<std::string>, Entry> programs_;
  FileContents failed_;  ///< what was read of shaders that did not compile
};

[[nodiscard]] std::shared_ptr<ShaderLibrary> make_library(const gpu::Device& device, const ShaderFolders& folders);

}  // namespace lightloom::run
