#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace lightloom::image {

/// Files of a sequence by frame number, or one file on its own.
struct FrameFiles {
  std::map<uint32_t, std::filesystem::path> files;  ///< at least one
  bool single = false;                              ///< one file that was named as such; its number, 0, means nothing
};

/// `place` is one of
///   a run folder       its files OUTPUT.FFFF.EXT; floats (.exr, .npy, .hdr, .tif) are preferred to .png and .jpg
///   a pattern          whose last component has %04d, %d or #### for the frame number; that many digits or more
///   a file
/// Throws Error(invalid_input) where there is no such file, or a folder or pattern has no frame.
[[nodiscard]] FrameFiles find_frames(const std::filesystem::path& place, const std::string& output);

/// True if the last component of the path has a place for a frame number.
[[nodiscard]] bool has_frame_number(const std::filesystem::path& pattern);

/// The pattern with the frame number in its place, zeros in front.
[[nodiscard]] std::filesystem::path with_frame_number(const std::filesystem::path& pattern, uint32_t frame);

}  // namespace lightloom::image
