#include "framework/run/shader_library.hpp"

namespace lightloom::run {

const gpu::ShaderProgram& ShaderLibrary::program(const std::vector<std::string>& files) {
  const auto found = programs_.find(files);
  if (found != programs_.end()) return found->second;
  return programs_.emplace(files, gpu::make_program(compiler_.compile_files(files))).first->second;
}

}  // namespace lightloom::run
