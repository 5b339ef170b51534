#include "framework/study/tonemap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightloom::study {
namespace {

double curve_value(double x, const std::string& curve) {
  if (curve == "filmic") return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (curve == "reinhard") return x / (1 + x);
  return x;
}

double encode_srgb(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

}  // namespace

ToneMap tone_map_of(const Plan& plan) {
  ToneMap how;
  for (const GraphPass& pass : plan.graph.passes) {
    if (pass.type == nullptr || pass.type->name != "tonemap") continue;
    if (pass.params.find("exposure") != nullptr) how.exposure = pass.params.real("exposure");
    if (pass.params.find("curve") != nullptr) how.curve = pass.params.choice("curve");
    break;
  }
  return how;
}

image::HostImage tone_map(const image::HostImage& radiance, const ToneMap& how) {
  const Extent3 extent = radiance.desc.extent;
  image::HostImage shown{{Format::rgba8_unorm, Dimension::d2, {extent.width, extent.height, 1}}, {}};
  shown.texels.reserve(size_t{4} * extent.width * extent.height);
  const double scale = std::exp2(how.exposure);
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) {
      std::array<double, 3> color{};
      for (uint32_t c = 0; c < 3; ++c) color[c] = radiance.at(x, y, 0, c);
      const bool finite = std::all_of(color.begin(), color.end(), [](double value) { return std::isfinite(value); });
      for (const double value : color) {
        const double exposed = finite ? std::clamp(value * scale, 0.0, 1e9) : 0;
        const double display = encode_srgb(std::clamp(curve_value(exposed, how.curve), 0.0, 1.0));
        shown.texels.push_back(static_cast<std::byte>(std::lround(255 * display)));
      }
      shown.texels.push_back(std::byte{255});
    }
  return shown;
}

}  // namespace lightloom::study
