#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lightloom {

/// The whole file. Throws Error(invalid_input) "cannot read FILE: reason".
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// Writes beside the target under a temporary name and renames, so that the file appears whole or not at all; missing
/// parent folders are made. Throws Error(run_failed) "cannot write FILE: reason", leaving nothing behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lightloom
