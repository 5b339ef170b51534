#pragma once

#include <filesystem>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Writes a 2D rgba8_unorm image as an 8-bit RGB file, alpha dropped, whole or not at all. The values are taken as
/// display-ready (sRGB) and go out as they are. Throws Error (run_failed) for any other shape or format.
void write_png(const std::filesystem::path& file, const HostImage& image);

/// 8-bit image as rgba8_unorm; grey is spread over R, G, B, a missing alpha is 255, 16-bit samples are rounded, alpha
/// is not multiplied in. Throws Error (invalid_input) for a missing or broken file.
[[nodiscard]] HostImage read_png(const std::filesystem::path& file);

}  // namespace lightloom::image
