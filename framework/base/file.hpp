#pragma once

#include <filesystem>
#include <string>

namespace lightloom {

/// The whole file. Throws Error(invalid_input) "cannot read 'FILE': reason".
/// Writing is in atomic_file.hpp.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

}  // namespace lightloom
