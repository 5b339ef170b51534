#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace lightloom {

/// Writes a file whole or not at all: the bytes go to a hidden file beside it, which is then renamed over
/// `file`. On any failure (missing or unwritable folder, full disk) the hidden file is removed, an older `file` stays
/// as it was, and Error (run_failed) says which file and why. The folder must exist.
void write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace lightloom
