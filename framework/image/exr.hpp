#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Names of the channels of a value in an EXR file. Colours are R G B A; directions, positions and the like (told by
/// the name of the part or port) X Y Z W; one channel has the value's own name; an `id` is object,
/// material, triangle, weights (of the corners); other pairs are X Y.
[[nodiscard]] std::vector<std::string> default_channel_names(const ImageDesc& desc, std::string_view port,
                                                             std::string_view part);

/// Writes a 2D image, whole or not at all. half, float and uint channels go out bit for bit; unorm8 goes out as half
/// (v/255, which keeps all 256 values apart). Throws Error (run_failed) for a 3D image, a wrong number of names, or a
/// file that cannot be written.
void write_exr(const std::filesystem::path& file, const HostImage& image,
               const std::vector<std::string>& channel_names);

/// An EXR file's first part; samples tightly packed, channels innermost, row 0 on top.
struct ExrImage {
  uint32_t width = 0;
  uint32_t height = 0;
  ChannelType type = ChannelType::float32;  ///< half, float32 or uint32; mixed channels are widened to float32
  std::vector<std::string> channels;        ///< R G B A and X Y Z first and in this order, the others as in the file
  std::vector<std::byte> samples;

  /// Sample as a number; throws std::out_of_range outside the image or for a channel that it does not have.
  [[nodiscard]] double at(uint32_t x, uint32_t y, std::string_view channel) const;
};

/// Throws Error (invalid_input) for a missing, broken or unsupported file.
[[nodiscard]] ExrImage read_exr(const std::filesystem::path& file);

}  // namespace lightloom::image
