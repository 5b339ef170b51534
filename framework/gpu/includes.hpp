#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/base/file_watch.hpp"
#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::gpu {

/// Texts of all files that shaders include, directly or through others, by the name that stands in `#include`.
using IncludeTexts = std::map<std::string, std::string, std::less<>>;

/// The first of `directories` that has a file `name`, or an empty path.
[[nodiscard]] std::filesystem::path find_file(const std::string& name,
                                              std::span<const std::filesystem::path> directories);

/// Notes a file's text as what was read under that name, and that folders searched before had no such file. An empty
/// `text`: none had.
void note_file(const std::string& name, std::span<const std::filesystem::path> directories,
               const std::optional<std::string>& text, FileContents& files);

/// Follows the `#include "name"` lines of `sources`, whether or not a condition hides them. A file that is not there is
/// left out: the compiler reports it if the line counts. Notes what was looked for in `files`. Throws
/// Error(invalid_input) for a cycle.
[[nodiscard]] IncludeTexts collect_includes(std::span<const ShaderSource> sources,
                                            std::span<const std::filesystem::path> directories, FileContents& files);

}  // namespace lightloom::gpu
