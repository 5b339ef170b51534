#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/file_watch.hpp"
#include "framework/gpu/shader_compiler.hpp"

namespace lightloom::gpu {

/// Texts of all files that shaders include, directly or through others, by the name that stands in `#include`.
using IncludeTexts = std::map<std::string, std::string, std::less<>>;

constexpr uint64_t kMostShaderBytes = uint64_t{16} << 20;  ///< of one file, and of all that a stage includes

/// Without the byte order mark that editors may put before UTF-8.
[[nodiscard]] std::string_view without_mark(std::string_view text);

/// The first of `directories` that has a file `name`, or an empty path.
[[nodiscard]] std::filesystem::path find_file(const std::string& name,
                                              std::span<const std::filesystem::path> directories);

/// Notes a file's text as what was read under that name, and that folders searched before had no such file. An empty
/// `text`: none had.
void note_file(const std::string& name, std::span<const std::filesystem::path> directories,
               const std::optional<std::string>& text, FileContents& files);

/// Follows the `#include "name"` lines of `sources`, whether or not a condition hides them. A file that is not there is
/// left out: the compiler reports it if the line counts. Notes what was looked for in `files`. Throws
/// Error(invalid_input) for a cycle, for files nested too deep, and for one that is too large.
[[nodiscard]] IncludeTexts collect_includes(std::span<const ShaderSource> sources,
                                            std::span<const std::filesystem::path> directories, FileContents& files);

}  // namespace lightloom::gpu
