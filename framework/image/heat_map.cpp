#include <algorithm>
#include <array>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/image/metrics.hpp"

namespace lightloom::image {
namespace {

/// sRGB, 0..1.
using MapColor = std::array<double, 3>;

/// Every 8th of the 256 colours of magma, and the last (N. Smith, S. van der Walt, E. Firing; matplotlib, CC0). Between
/// them lie straight lines.
constexpr double kKnotStep = 8;
constexpr double kLastIndex = 255;
constexpr std::array<MapColor, 33> kKnots = {{
    {0.001462, 0.000466, 0.013866}, {0.013708, 0.011771, 0.068667}, {0.039608, 0.031090, 0.133515},
    {0.074257, 0.052017, 0.202660}, {0.113094, 0.065492, 0.276784}, {0.159018, 0.068354, 0.352688},
    {0.211718, 0.061992, 0.418647}, {0.265447, 0.060237, 0.461840}, {0.316654, 0.071690, 0.485380},
    {0.366012, 0.090314, 0.497960}, {0.414709, 0.110431, 0.504662}, {0.463508, 0.129893, 0.507652},
    {0.512831, 0.148179, 0.507648}, {0.562866, 0.165368, 0.504692}, {0.613617, 0.181811, 0.498536},
    {0.664915, 0.198075, 0.488836}, {0.716387, 0.214982, 0.475290}, {0.767398, 0.233705, 0.457755},
    {0.816914, 0.255895, 0.436461}, {0.863320, 0.283729, 0.412403}, {0.904281, 0.319610, 0.388137},
    {0.937221, 0.364929, 0.368567}, {0.960949, 0.418323, 0.359630}, {0.976690, 0.476226, 0.364466},
    {0.986700, 0.535582, 0.382210}, {0.992785, 0.594891, 0.410283}, {0.996096, 0.653659, 0.446213},
    {0.997325, 0.711848, 0.488154}, {0.996898, 0.769591, 0.534892}, {0.995131, 0.827052, 0.585701},
    {0.992440, 0.884330, 0.640099}, {0.989434, 0.941470, 0.697519}, {0.987053, 0.991438, 0.749504},
}};
constexpr MapColor kNotANumber = {0, 1, 0};  // not on the map

MapColor magma(double value) {
  if (std::isnan(value)) return kNotANumber;
  const double index = std::clamp(value, 0.0, 1.0) * kLastIndex;
  const auto knot = std::min(static_cast<size_t>(index / kKnotStep), kKnots.size() - 2);
  const double begin = static_cast<double>(knot) * kKnotStep;
  const double along = (index - begin) / (std::min(begin + kKnotStep, kLastIndex) - begin);
  MapColor color{};
  for (size_t c = 0; c < 3; ++c) color[c] = std::lerp(kKnots[knot][c], kKnots[knot + 1][c], along);
  return color;
}

}  // namespace

HostImage heat_map(const HostImage& map, double white) {
  if (map.desc.format != Format::r32_sfloat || map.desc.dimension != Dimension::d2) {
    throw Error(ExitCode::invalid_input, "a heat map is made of an r32_sfloat image, not of " + to_string(map.desc));
  }
  if (!(std::isfinite(white) && white > 0)) {
    throw Error(ExitCode::invalid_input, "the brightest value of a heat map must be above 0");
  }
  HostImage colors;
  colors.desc = {Format::rgba8_unorm, Dimension::d2, map.desc.extent};
  colors.texels.reserve(byte_size(colors.desc));
  for (uint32_t y = 0; y < map.desc.extent.height; ++y) {
    for (uint32_t x = 0; x < map.desc.extent.width; ++x) {
      for (const double channel : magma(map.at(x, y, 0, 0) / white))
        colors.texels.push_back(static_cast<std::byte>(std::lround(channel * 255)));
      colors.texels.push_back(std::byte{255});
    }
  }
  return colors;
}

}  // namespace lightloom::image
