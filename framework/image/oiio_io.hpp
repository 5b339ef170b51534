#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <string>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Encodes `samples` (laid out as `spec` says) in memory, so that a full disk is met by the atomic writer alone, and
/// writes the file. `format` is OpenImageIO's name of the file format.
void encode_and_write(const std::filesystem::path& file, const std::string& format, const OIIO::ImageSpec& spec,
                      const void* samples);

/// Opens a file of that format (the content decides, not the extension); Error (invalid_input) where it is missing,
/// broken, or something else.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file, const std::string& format,
                                                           const OIIO::ImageSpec& config);

/// The same for a file of any format that OpenImageIO knows.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file,
                                                           const OIIO::ImageSpec& config);

/// Reads all of the first part as `type`, tightly packed, into `samples`.
void read_samples(OIIO::ImageInput& input, const std::filesystem::path& file, const OIIO::TypeDesc& type,
                  void* samples);

/// Throws Error (run_failed) unless the image has as many texels as its description says.
void require_complete(const HostImage& image, const std::filesystem::path& file);

}  // namespace lightloom::image
