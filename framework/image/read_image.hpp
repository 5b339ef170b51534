#pragma once

#include <filesystem>
#include <string>

#include "framework/base/limits.hpp"
#include "framework/image/host_image.hpp"

namespace lightloom::image {

struct ReadOptions {
  /// Which channels of a file that names them: a channel (gives a grey image) or a layer, whose NAME.R, NAME.G, NAME.B
  /// are taken. Empty: R, G, B; or the only channel; or the only three, alpha aside.
  std::string channel;
  bool linear = false;  ///< take 8 and 16 bit samples as they are
  Limits limits;        ///< float_texels, image_side and file_bytes count
};

struct ReadImage {
  HostImage image;       ///< r32_sfloat, rgba32_sfloat (alpha 1), or as in the .npy file
  bool display = false;  ///< the file's samples have 8 or 16 bits and stand for 0..1
  bool decoded = false;  ///< the transfer function of sRGB was removed from them
};

/// Reads any 2D image that OpenImageIO reads (the first part of a file with several), and .npy files of this program.
/// Integer samples of 8 or 16 bits stand for 0..1 and, unless the file says that it is linear, have the transfer
/// function of sRGB (IEC 61966-2-1) removed; .npy files never have it. Throws Error(invalid_input) for a missing,
/// broken or unsupported file, for channels that it does not have, and for what is beyond the limits, of which the
/// header of a PNG, JPEG, Radiance HDR or OpenEXR file is asked before any decoder sees it.
[[nodiscard]] ReadImage read_image(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace lightloom::image
