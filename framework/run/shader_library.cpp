#include "framework/run/shader_library.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "framework/base/interrupt.hpp"

namespace lightloom::run {

const gpu::ShaderProgram& ShaderLibrary::program(const std::vector<std::string>& files) {
  const auto found = programs_.find(files);
  if (found != programs_.end()) {
    found->second.used = true;
    return found->second.program;
  }
  stop_if_interrupted();
  const auto start = std::chrono::steady_clock::now();
  std::vector<gpu::SpirvModule> modules;
  try {
    modules = compiler_.compile_files(files);
  } catch (...) {
    failed_.insert(compiler_.files_read().begin(), compiler_.files_read().end());
    throw;
  }
  Entry entry{gpu::make_program(std::move(modules)), compiler_.files_read()};
  compile_milliseconds_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return programs_.emplace(files, std::move(entry)).first->second.program;
}

FileContents ShaderLibrary::files_read() const {
  FileContents files = failed_;
  for (const auto& [names, entry] : programs_) files.insert(entry.read.begin(), entry.read.end());
  return files;
}

void ShaderLibrary::forget(const std::vector<std::filesystem::path>& changed) {
  failed_.clear();
  std::erase_if(programs_, [&](const auto& program) {
    return std::any_of(changed.begin(), changed.end(),
                       [&](const std::filesystem::path& file) { return program.second.read.contains(file); });
  });
}

void ShaderLibrary::drop_unused() {
  std::erase_if(programs_, [](const auto& program) { return !program.second.used; });
  for (auto& [names, entry] : programs_) entry.used = false;
}

std::shared_ptr<ShaderLibrary> make_library(const gpu::Device& device, const ShaderFolders& folders) {
  return std::make_shared<ShaderLibrary>(
      device, gpu::ShaderCompilerOptions{.include_directories = folders.sources, .cache_directory = folders.cache});
}

}  // namespace lightloom::run
