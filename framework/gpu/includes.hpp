#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::gpu {

/// Texts of all files that shaders include, directly or through others, by the name that stands in `#include`.
using IncludeTexts = std::map<std::string, std::string, std::less<>>;

/// The first of `directories` that has a file `name`, or an empty path.
[[nodiscard]] std::filesystem::path find_file(const std::string& name,
                                              std::span<const std::filesystem::path> directories);

/// Follows the `#include "name"` lines of `sources`, whether or not a condition hides them. A file that is not there is
/// left out: the compiler reports it if the line counts. Throws Error(invalid_input) for a cycle.
[[nodiscard]] IncludeTexts collect_includes(std::span<const ShaderSource> sources,
                                            std::span<const std::filesystem::path> directories);

}  // namespace lightloom::gpu
