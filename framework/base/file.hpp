#pragma once

#include <filesystem>
#include <string>

namespace lightloom {

/// The whole file. Throws Error(invalid_input) "cannot read 'FILE': reason".
/// Writing is in atomic_file.hpp.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// Makes a folder with those above it, where it is not there yet. Throws Error(run_failed) "cannot make the folder 'X':
/// reason".
void make_folder(const std::filesystem::path& folder);

}  // namespace lightloom
