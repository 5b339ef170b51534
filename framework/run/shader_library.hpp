#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/gpu/pipeline.hpp"
#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::run {

/// Compiled shader programs by file names, and their pipelines.
class ShaderLibrary {
 public:
  ShaderLibrary(const gpu::Device& device, gpu::ShaderCompilerOptions options)
      : compiler_(std::move(options)), pipelines_(device) {}
  const gpu::ShaderProgram& program(const std::vector<std::string>& files);
  /// Where a program's shaders declare a name of their interface: "file:line".
  [[nodiscard]] std::string declaration(const std::vector<std::string>& files, std::string_view name) const {
    return compiler_.declaration(files, name);
  }
  [[nodiscard]] gpu::PipelineCache& pipelines() { return pipelines_; }

 private:
  gpu::ShaderCompiler compiler_;
  gpu::PipelineCache pipelines_;
  std::map<std::vector<std::string>, gpu::ShaderProgram> programs_;
};

}  // namespace lightloom::run
