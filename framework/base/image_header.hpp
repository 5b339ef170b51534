#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "framework/base/limits.hpp"

namespace lightloom {

enum class ImageFileFormat : uint8_t { unknown, png, jpeg, hdr, exr };

/// By the first bytes.
[[nodiscard]] ImageFileFormat image_file_format(std::span<const uint8_t> bytes);

/// What a picture file says it holds, read without a decoder and without allocating anything for it.
struct ImageHeader {
  ImageFileFormat format = ImageFileFormat::unknown;
  uint64_t width = 0;  ///< of the largest part, as OpenEXR files may have several
  uint64_t height = 0;
  uint64_t channels = 0;  ///< the most of any part
  uint64_t chunks = 0;    ///< EXR: rows or tiles of a table that decoders hold in memory
  uint64_t scans = 0;     ///< JPEG: passes over the whole image
  bool whole = true;      ///< PNG and JPEG: the file reaches the end of its image
};

/// Header of a PNG (ISO/IEC 15948), JPEG (ITU-T T.81), Radiance HDR or OpenEXR file. Empty where it is none of them or
/// the header is broken; `problem` then says why, fit to follow the file's name.
[[nodiscard]] std::optional<ImageHeader> read_image_header(std::span<const uint8_t> bytes, std::string& problem);

/// Throws Error for an image larger than `texels` (a limit: image_texels or float_texels) or image_side allow, with
/// more scans than jpeg_scans, or with a table of chunks out of proportion; `element` names the image.
void require_image_within(const ImageHeader& header, const Limits& limits, uint64_t Limits::*texels,
                          const std::string& element);

}  // namespace lightloom
