#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace lightloom {

/// What a file that was written outlives: the end of the process, or a loss of power too, for which all that was
/// written to its file system waits until the disk has it.
enum class Durability { process_end, power_loss };

/// Writes a file whole or not at all: the bytes go to a hidden file beside it, which is then renamed over
/// `file`. On any failure (missing or unwritable folder, full disk) the hidden file is removed, an older `file` stays
/// as it was, and Error (run_failed) says which file and why, and how much room it needs where the disk is full. The
/// folder must exist.
void write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes,
                           Durability durability = Durability::process_end);
void write_file_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace lightloom
