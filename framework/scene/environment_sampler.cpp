#include "framework/scene/environment_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "framework/scene/color.hpp"

namespace lightloom::scene {
namespace {

constexpr double kSteps = 0x1p24;  ///< values that a uniform random number has

/// Integral, up to x, of the weight that linear filtering gives to a texel at distance x from its centre [texels].
double filter_integral(double x) {
  if (x <= -1) return 0;
  if (x >= 1) return 1;
  return x < 0 ? 0.5 * (x + 1) * (x + 1) : 1 - 0.5 * (1 - x) * (1 - x);
}

/// Share of one texel in the mean of the filtered image over one cell, along one axis.
struct Share {
  uint32_t texel = 0;
  double weight = 0;
};

/// Shares in the cell `cell` of `cells` that divide `texels` evenly; beyond the ends the texels repeat or the last one
/// goes on.
std::vector<Share> shares(uint32_t cell, uint32_t cells, uint32_t texels, bool repeat) {
  const double width = static_cast<double>(texels) / cells;
  const double begin = cell * width, end = begin + width;
  std::vector<Share> found;
  for (auto t = static_cast<int64_t>(std::floor(begin)) - 1; t <= static_cast<int64_t>(std::ceil(end)); ++t) {
    const double centre = static_cast<double>(t) + 0.5;
    const double weight = (filter_integral(end - centre) - filter_integral(begin - centre)) / width;
    const int64_t count = texels;
    const int64_t inside = repeat ? ((t % count) + count) % count : std::clamp<int64_t>(t, 0, count - 1);
    if (weight > 0) found.push_back({static_cast<uint32_t>(inside), weight});
  }
  return found;
}

double texel_luminance(const Environment& environment, uint32_t x, uint32_t y) {
  const size_t texel = (size_t{y} * environment.width + x) * 3;
  const glm::vec3 color(environment_texel(environment, texel), environment_texel(environment, texel + 1),
                        environment_texel(environment, texel + 2));
  return static_cast<double>(std::min(luminance(color * environment.radiance), std::numeric_limits<float>::max()));
}

/// Luminance of the filtered image, averaged over each cell.
std::vector<double> cell_luminances(const Environment& environment, uint32_t columns, uint32_t rows) {
  std::vector<double> narrow(size_t{columns} * environment.height);
  for (uint32_t c = 0; c < columns; ++c) {
    const std::vector<Share> horizontal = shares(c, columns, environment.width, true);
    for (uint32_t y = 0; y < environment.height; ++y)
      for (const Share& share : horizontal)
        narrow[size_t{y} * columns + c] += share.weight * texel_luminance(environment, share.texel, y);
  }
  std::vector<double> cells(size_t{columns} * rows);
  for (uint32_t r = 0; r < rows; ++r)
    for (const Share& share : shares(r, rows, environment.height, false))
      for (uint32_t c = 0; c < columns; ++c)
        cells[size_t{r} * columns + c] += share.weight * narrow[size_t{share.texel} * columns + c];
  return cells;
}

/// Cumulative probabilities in proportion to `weights`, rounded to multiples of 1 / kSteps. Each weight above 0 gets
/// one step ahead of its share of the rest, so that none is lost; all 0 if all weights are.
std::vector<double> cumulative_probabilities(std::span<const double> weights) {
  double total = 0, positive = 0;
  for (const double weight : weights) {
    total += weight;
    positive += weight > 0 ? 1 : 0;
  }
  std::vector<double> cumulative;
  double sum = 0, count = 0;
  for (const double weight : weights) {
    sum += weight;
    count += weight > 0 ? 1 : 0;
    const double share = total > 0 ? std::min(sum / total, 1.0) : 0.0;
    cumulative.push_back((std::round(share * (kSteps - positive)) + count) / kSteps);
  }
  return cumulative;
}

double step(const std::vector<double>& cumulative, size_t index) {
  return cumulative[index] - (index == 0 ? 0 : cumulative[index - 1]);
}

}  // namespace

EnvironmentTable build_environment_table(const Environment& environment) {
  EnvironmentTable table;
  const bool constant = environment.rgb.empty();
  if (!constant) {
    table.columns = std::min(environment.width, kEnvironmentColumns);
    table.rows = std::min(environment.height, kEnvironmentRows);
  }
  const uint32_t columns = table.columns, rows = table.rows;
  const std::vector<double> luminances = constant
                                             ? std::vector<double>{static_cast<double>(luminance(environment.radiance))}
                                             : cell_luminances(environment, columns, rows);
  // Where rows end: in the precision that shaders have, so that solid angles and densities fit them.
  std::vector<float> edges(rows);
  for (uint32_t r = 0; r < rows; ++r)
    edges[r] = r + 1 == rows ? -1.0f : static_cast<float>(std::cos(std::numbers::pi * (r + 1) / rows));
  const auto solid_angle = [&](uint32_t r) {
    const double top = r == 0 ? 1.0 : static_cast<double>(edges[r - 1]);
    return (top - static_cast<double>(edges[r])) * 2 * std::numbers::pi / columns;
  };

  std::vector<double> row_weights(rows);
  for (uint32_t r = 0; r < rows; ++r)
    for (uint32_t c = 0; c < columns; ++c) row_weights[r] += luminances[size_t{r} * columns + c] * solid_angle(r);
  const std::vector<double> row_cumulative = cumulative_probabilities(row_weights);
  for (uint32_t r = 0; r < rows; ++r) {
    const std::vector<double> in_row =
        cumulative_probabilities(std::span(luminances).subspan(size_t{r} * columns, columns));
    for (uint32_t c = 0; c < columns; ++c)
      table.texels.emplace_back(static_cast<float>(in_row[c]),
                                static_cast<float>(step(row_cumulative, r) * step(in_row, c) / solid_angle(r)));
    table.texels.emplace_back(static_cast<float>(row_cumulative[r]), edges[r]);
  }
  return table;
}

}  // namespace lightloom::scene
