#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/graph/desc.hpp"

namespace lightloom::run {

[[nodiscard]] uint64_t texel_count(const ImageDesc& desc);
/// x, y and, of a volume, z of a texel numbered x fastest, then y, then z.
[[nodiscard]] std::vector<uint32_t> texel_coordinates(const ImageDesc& desc, uint32_t number);
[[nodiscard]] std::string texel_place(const ImageDesc& desc, uint32_t number);  ///< "12,7" or "12,7,3"
/// Each channel of a texel from its raw bits: "0.25", "nan", "-inf", "17".
[[nodiscard]] std::vector<std::string> channel_texts(const ImageDesc& desc, const std::array<uint32_t, 4>& raw);
[[nodiscard]] std::string texel_text(const ImageDesc& desc, const std::array<uint32_t, 4>& raw);  ///< "(0.25, nan)"

}  // namespace lightloom::run
