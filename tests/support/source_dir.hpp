#pragma once

#include <filesystem>

namespace lightloom {

/// The checkout that the tests were built from.
[[nodiscard]] std::filesystem::path source_dir();

}  // namespace lightloom
