#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lightloom::samples {

/// 8-bit picture, row 0 on top, `channels` bytes a pixel (3: RGB, 4: RGB and alpha, not premultiplied).
struct Picture {
  uint32_t width = 0, height = 0, channels = 3;
  std::vector<uint8_t> bytes;
};

/// All pictures below tile in both directions where their material repeats them.
[[nodiscard]] Picture floor_tiles();          ///< 4 x 4 tiles in two colours, sRGB
[[nodiscard]] Picture floor_tiles_surface();  ///< green: roughness, blue: metallic (0); the joints are rough
[[nodiscard]] Picture brick_colour();         ///< 4 x 8 bricks, sRGB
[[nodiscard]] Picture brick_normal();         ///< the same bricks as a tangent-space normal map, green up
[[nodiscard]] Picture palm_frond();           ///< leaf with gaps, alpha 0 or 255; the stem is at the bottom
[[nodiscard]] Picture iron_grille();          ///< one bay of a railing, alpha 0 or 255

/// Throws std::runtime_error that names the file.
void write_png(const Picture& picture, const std::filesystem::path& file);

}  // namespace lightloom::samples
