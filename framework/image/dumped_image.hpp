#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Reads the texels of a value back from the .exr or .npy file that it was dumped to, bit for bit as the device had
/// them: `desc` is the value's, `channel_names` those it was written with (default_channel_names). Throws
/// Error(invalid_input) for a file of another size, other channels or another sample type.
[[nodiscard]] HostImage read_dumped(const std::filesystem::path& file, const ImageDesc& desc,
                                    const std::vector<std::string>& channel_names);

}  // namespace lightloom::image
