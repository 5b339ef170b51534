#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/file_watch.hpp"

namespace lightloom::gpu {

enum class Stage : uint8_t { vertex, fragment, compute };
[[nodiscard]] std::string to_string(Stage stage);

/// GLSL of one stage. `name` is what messages show; shaders carry no set, binding or varying location: names are the
/// interface.
struct ShaderSource {
  std::string name;
  std::string text;
  Stage stage = Stage::compute;
};

/// SPIR-V 1.6 of one stage.
struct SpirvModule {
  std::string name;
  Stage stage = Stage::compute;
  std::vector<uint32_t> words{};
};

using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

struct ShaderCompilerOptions {
  /// Roots for `#include "lib/x.glsl"` and for `compile_files`, searched in order.
  std::vector<std::filesystem::path> include_directories{};
  std::filesystem::path cache_directory{};  ///< made when missing; empty: no cache on disk
};

struct CompileStatistics {
  uint32_t compiled = 0;
  uint32_t from_cache = 0;
  uint32_t rejected_cache_entries = 0;  ///< damaged ones, compiled anew
  std::string cache_write_failure;      ///< why the last entry could not be written; empty if all could
};

/// GLSL (460 unless `#version` says otherwise; GL_GOOGLE_include_directive and GL_EXT_samplerless_texture_functions are
/// on) to SPIR-V for Vulkan 1.3. One thread at a time.
class ShaderCompiler {
 public:
  explicit ShaderCompiler(ShaderCompilerOptions options);

  /// Compiles the stages of one pipeline together: a resource name has one binding (set 0) in all of them, a varying
  /// one location. Throws Error(invalid_input): "file:line: message" of the first problem, the others in the hint.
  [[nodiscard]] std::vector<SpirvModule> compile(std::span<const ShaderSource> stages,
                                                 const ShaderDefines& defines = {});
  /// Files found in the include directories; the stage is told by the extension .vert, .frag or .comp. Beside a file
  /// that is named by its whole path its includes are looked for first.
  [[nodiscard]] std::vector<SpirvModule> compile_files(std::span<const std::string> files,
                                                       const ShaderDefines& defines = {});
  /// Where the files, or what they include, declare a name of their interface: "file:line"; their names if none does.
  [[nodiscard]] std::string declaration(std::span<const std::string> files, std::string_view name) const;
  [[nodiscard]] const CompileStatistics& statistics() const { return statistics_; }
  /// What the last of these calls read, whether or not it threw: shaders and includes in the include directories, and
  /// that those searched before had none of that name.
  [[nodiscard]] const FileContents& files_read() const { return files_read_; }

 private:
  [[nodiscard]] std::vector<SpirvModule> compile_with(std::span<const ShaderSource> stages,
                                                      const ShaderDefines& defines,
                                                      std::span<const std::filesystem::path> folders);

  ShaderCompilerOptions options_;
  CompileStatistics statistics_;
  FileContents files_read_;
};

}  // namespace lightloom::gpu
