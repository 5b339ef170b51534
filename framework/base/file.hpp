#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lightloom {

constexpr uint64_t kMostTextBytes = uint64_t{1} << 30;

/// The whole of a regular file; pipes and devices are refused, as they may never end. Throws Error(invalid_input)
/// "cannot read 'FILE': reason", also where the file is larger than `most_bytes`. Writing is in atomic_file.hpp.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path, uint64_t most_bytes = kMostTextBytes);

/// Makes a folder with those above it, where it is not there yet. Throws Error(run_failed) "cannot make the folder 'X':
/// reason".
void make_folder(const std::filesystem::path& folder);

}  // namespace lightloom
