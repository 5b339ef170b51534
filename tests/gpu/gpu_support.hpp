#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/gpu/pipeline.hpp"
#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::test {

inline gpu::ShaderSource compute_source(std::string text, std::string name = "test.comp") {
  return {.name = std::move(name), .text = std::move(text), .stage = gpu::Stage::compute};
}

inline gpu::ShaderProgram compile_program(const std::vector<gpu::ShaderSource>& stages,
                                          gpu::ShaderCompilerOptions options = {}) {
  gpu::ShaderCompiler compiler(std::move(options));
  return gpu::make_program(compiler.compile(stages));
}

inline gpu::ShaderProgram compile_compute(const std::string& text) {
  return compile_program({compute_source(text)});
}

/// The Error that `action` throws; fails the test if it throws none.
inline Error error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no Error was thrown";
  return Error(ExitCode::done, "");
}

template <class T>
std::vector<T> values_of(std::span<const std::byte> bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

/// A folder that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    path_ = std::filesystem::temp_directory_path() /
            ("lightloom_test_" + std::to_string(std::random_device{}()) + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace lightloom::test
