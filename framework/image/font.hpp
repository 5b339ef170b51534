#pragma once

#include <array>
#include <cstdint>

namespace lightloom::image {

constexpr uint32_t kGlyphWidth = 5;
constexpr uint32_t kGlyphAscent = 7;  ///< rows above the base line
constexpr uint32_t kGlyphHeight = 9;  ///< with the two below it

/// Rows of a letter from the top, the leftmost pixel in bit 4. Lower case letters, digits and .,:-+=/^()| are there;
/// upper case is shown as lower case, anything else as a box.
[[nodiscard]] const std::array<uint8_t, kGlyphHeight>& glyph_rows(char letter);

}  // namespace lightloom::image
