#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/gpu/includes.hpp"
#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::gpu {

/// Name and version of the compiler and of the settings it is used with; part of every cache key.
[[nodiscard]] std::string compiler_identity();

/// One program by glslang; see ShaderCompiler::compile.
[[nodiscard]] std::vector<SpirvModule> compile_glsl(std::span<const ShaderSource> stages, const ShaderDefines& defines,
                                                    const IncludeTexts& includes,
                                                    std::span<const std::filesystem::path> include_directories);

}  // namespace lightloom::gpu
