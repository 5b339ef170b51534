#pragma once

#include <filesystem>

#include "framework/base/limits.hpp"
#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Writes an image as a NumPy array (.npy, format version 1.0), whole or not at all: C order, shape (z, y, x, c) for 3D
/// and (y, x, c) for 2D images; dtype |u1 for unorm8 (0..255), <u2 for unorm16 (0..65535), <f2, <f4, <u4 otherwise.
/// `numpy.load` reads it. Throws Error (run_failed) where the file cannot be written.
void write_npy(const std::filesystem::path& file, const HostImage& image);

/// Reads what `write_npy` writes. Other dtypes, Fortran order, other ranks, channel counts that no texel format has,
/// and files that are too short or too long are Error (invalid_input), and what is beyond float_texels of `limits`, if
/// given. No more is read than the header says.
[[nodiscard]] HostImage read_npy(const std::filesystem::path& file, const Limits* limits = nullptr);

}  // namespace lightloom::image
