#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "framework/stability/check.hpp"
#include "framework/stability/scenes.hpp"
#include "framework/stability/statistics.hpp"

namespace lightloom::stability {
namespace {

/// Params of shaders/stability/random_bits.comp, and the size of its image.
struct Keys {
  uint32_t width = 256, height = 256;
  /// Pixel x, pixel y, frame, path, bounce, dimension, seed.
  std::array<uint32_t, 7> first{11, 17, 3, 0, 0, 1, 5};
  uint32_t along_x = 0, along_y = 1, step_x = 1, step_y = 1;
};
constexpr uint32_t kPixelX = 0, kPixelY = 1, kFrame = 2, kPath = 3, kBounce = 4, kDimension = 5, kSeed = 6;

using Bits = std::array<std::vector<uint32_t>, 4>;  ///< four words for each key, row by row

scene::Scene any_scene() {
  return make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
}

std::string number(uint32_t value) {
  return std::to_string(value);
}

std::string keys_graph(const Keys& keys) {
  const auto& w = keys.first;
  return R"({ "lightloom": 1, "name": "random_bits", "passes": { "bits": { "type": "compute",
      "shader": "stability/random_bits.comp", "out": { "bits": { "format": "rgba32_uint", "size": ")" +
         number(keys.width) + "x" + number(keys.height) + R"(" } }, "params": { "pixel_x": )" + number(w[kPixelX]) +
         R"(, "pixel_y": )" + number(w[kPixelY]) + R"(, "frame_low": )" + number(w[kFrame] & 0xFFFF) +
         R"(, "frame_high": )" + number(w[kFrame] >> 16) + R"(, "path": )" + number(w[kPath]) + R"(, "bounce": )" +
         number(w[kBounce]) + R"(, "dimension": )" + number(w[kDimension]) + R"(, "seed_low": )" +
         number(w[kSeed] & 0xFFFF) + R"(, "seed_high": )" + number(w[kSeed] >> 16) + R"(, "along_x": )" +
         number(keys.along_x) + R"(, "along_y": )" + number(keys.along_y) + R"(, "step_x": )" + number(keys.step_x) +
         R"(, "step_y": )" + number(keys.step_y) + R"( } } }, "outputs": { "bits": "bits.bits" } })";
}

Bits draw(Lab& lab, const Keys& keys) {
  const Images images = lab.last_frame(keys_graph(keys), any_scene());
  const image::HostImage& image = images.at("bits");
  Bits bits;
  for (uint32_t y = 0; y < keys.height; ++y)
    for (uint32_t x = 0; x < keys.width; ++x)
      for (uint32_t word = 0; word < 4; ++word) bits[word].push_back(static_cast<uint32_t>(image.at(x, y, 0, word)));
  return bits;
}

/// All four words of all keys as numbers in [0, 1).
std::vector<double> numbers(const Bits& bits) {
  std::vector<double> all;
  for (const std::vector<uint32_t>& word : bits)
    for (const uint32_t value : word) all.push_back((value >> 8u) * 0x1p-24);
  return all;
}

/// Correlation of independent uniform numbers, in its standard deviations.
double sigmas(const Bits& a, const Bits& b) {
  const std::vector<double> x = numbers(a), y = numbers(b);
  return std::abs(correlation(x, y)) * std::sqrt(static_cast<double>(x.size()));
}

Keys moved(Keys keys, uint32_t word, uint32_t by) {
  keys.first.at(word) += by;
  return keys;
}

/// Of 16 x 16 cells that pairs of numbers fall into.
double pair_chance(const std::vector<uint32_t>& first, const std::vector<uint32_t>& second, size_t skip = 0) {
  std::vector<double> counts(256);
  for (size_t k = 0; k + skip < first.size(); ++k) ++counts[(first[k] >> 28u) * 16 + (second[k + skip] >> 28u)];
  return uniformity_chance(counts);
}

/// The least chance of several tests, times their number: below 0.001 something is wrong.
class LeastChance {
 public:
  void add(double chance) {
    least_ = std::min(least_, chance);
    ++tests_;
  }
  [[nodiscard]] Figure figure(const std::string& what) const {
    return at_least(what + ": least chance of " + std::to_string(tests_) + " tests, times their number",
                    std::min(least_ * tests_, 1.0), 1e-3);
  }

 private:
  double least_ = 1;
  int tests_ = 0;
};

/// Of the bits from `lowest` on; the last 8 of a word, which numbers are not made of, are weak in this hash.
void add_bit_tests(const Bits& bits, LeastChance& chance, uint32_t lowest = 8) {
  for (const std::vector<uint32_t>& word : bits)
    for (uint32_t bit = lowest; bit < 32; ++bit) {
      std::array<double, 2> counts{};
      for (const uint32_t value : word) ++counts.at((value >> bit) & 1u);
      const double n = static_cast<double>(word.size());
      chance.add(std::erfc(std::abs(counts[1] - n / 2) / std::sqrt(n / 2)));
    }
}

void add_pair_tests(const Bits& bits, LeastChance& chance) {
  for (size_t first = 0; first < 4; ++first) {
    for (size_t second = first + 1; second < 4; ++second) chance.add(pair_chance(bits.at(first), bits.at(second)));
    chance.add(pair_chance(bits.at(first), bits.at(first), 1));
  }
}

/// First 4096 keys along one word of the key.
Keys sequence(uint32_t word) {
  Keys keys;
  keys.width = 4096;
  keys.height = 1;
  keys.along_x = word;
  keys.along_y = word;
  return keys;
}

double distinct(const std::vector<uint32_t>& values) {
  return static_cast<double>(std::set<uint32_t>(values.begin(), values.end()).size());
}

std::vector<Figure> measure_uniform_floats(Lab& lab) {
  const Images images = lab.last_frame(R"({ "lightloom": 1, "name": "uniform_floats", "passes": {
      "numbers": { "type": "compute", "shader": "stability/uniform_floats.comp",
                   "out": { "numbers": { "format": "rgba32_sfloat", "size": "4x1" } } } },
      "outputs": { "numbers": "numbers.numbers" } })",
                                       any_scene());
  const image::HostImage& numbers = images.at("numbers");
  double error = 0;
  for (uint32_t i = 0; i < 4; ++i)
    error = std::max(error, std::abs(numbers.at(i, 0, 0, 0) - std::floor(0x55555555u * double(i) / 256) / 16777216));
  return {equal("1 - number made of 0xffffffff", 1 - numbers.at(3, 0, 0, 0), std::pow(2, -24)),
          equal("number made of 0", numbers.at(0, 0, 0, 0), 0), at_most("largest error of four numbers", error, 0)};
}

std::vector<Figure> measure_uniformity(Lab& lab) {
  LeastChance bits, pairs, sequences;
  const Bits image = draw(lab, {});
  add_bit_tests(image, bits);
  add_pair_tests(image, pairs);
  for (const uint32_t word : {kFrame, kPath, kSeed}) add_pair_tests(draw(lab, sequence(word)), sequences);
  return {bits.figure("the 4 x 24 bits that numbers are made of, over 256 x 256 pixels"),
          pairs.figure("pairs of numbers over 256 x 256 pixels"),
          sequences.figure("pairs among the first 4096 frames, paths, seeds of a pixel"),
          at_least("distinct words of 10000 pixels", distinct({image[0].begin(), image[0].begin() + 10000}), 9998)};
}

std::vector<Figure> measure_autocorrelation(Lab& lab) {
  const Bits base = draw(lab, {});
  std::vector<Figure> figures;
  struct Lag {
    const char* what;
    uint32_t word, by;
  };
  for (const Lag& lag :
       {Lag{"next pixel of the row", kPixelX, 1}, Lag{"next row", kPixelY, 1}, Lag{"8 pixels on", kPixelX, 8},
        Lag{"next frame", kFrame, 1}, Lag{"next path", kPath, 1}, Lag{"next bounce", kBounce, 1},
        Lag{"next dimension", kDimension, 1}, Lag{"256 frames on", kFrame, 256}})
    figures.push_back(
        at_most(lag.what, sigmas(base, draw(lab, moved({}, lag.word, lag.by))), 3, "standard deviations"));
  double within = 0;
  for (size_t first = 0; first < 4; ++first)
    for (size_t second = first + 1; second < 4; ++second) {
      std::vector<double> a(base[first].begin(), base[first].end()), b(base[second].begin(), base[second].end());
      within = std::max(within, std::abs(correlation(a, b)) * std::sqrt(static_cast<double>(a.size())));
    }
  figures.push_back(at_most("numbers of one draw", within, 3, "standard deviations"));
  return figures;
}

std::vector<Figure> measure_seeds(Lab& lab) {
  constexpr uint32_t kSeeds = 32;
  const Bits base = draw(lab, {});
  double largest = 0, squares = 0;
  uint32_t worst = 0;
  for (uint32_t power = 0; power < kSeeds; ++power) {
    const double sigma = sigmas(base, draw(lab, moved({}, kSeed, 1u << power)));
    squares += sigma * sigma;
    if (sigma > largest) worst = power;
    largest = std::max(largest, sigma);
  }
  // What is chance among these numbers is not found again among others: pixels elsewhere, in four frames.
  double again = 0;
  for (uint32_t frame = 1; frame <= 4; ++frame) {
    const Keys elsewhere = moved(moved({}, kPixelX, 4096), kFrame, frame * 1000);
    again = std::max(again, sigmas(draw(lab, elsewhere), draw(lab, moved(elsewhere, kSeed, 1u << worst))));
  }
  return {at_most("seeds 2^0 to 2^31 apart, the largest of 32 correlations", largest, 3, "standard deviations"),
          at_most("mean square of the 32, 1 expected", (squares / kSeeds - 1) / std::sqrt(2.0 / kSeeds), 3,
                  "standard deviations"),
          at_most("the most correlated two seeds, in four sets of other numbers", again, 3, "standard deviations")};
}

std::vector<Figure> measure_far_keys(Lab& lab) {
  LeastChance chance;
  Keys far;
  far.first = {65280, 65280, 0xFFFFFFFFu, 65535, 255, 255, 0xFFFFFFFFu};
  Keys frames = sequence(kFrame);
  frames.first = {65535, 65535, 0xFFFFF000u, 0, 0, 0, 0};
  Keys bounces = far;
  bounces.first[kBounce] = bounces.first[kDimension] = 0;
  bounces.along_x = kBounce;
  bounces.along_y = kDimension;
  size_t repeated = 0;
  for (const Keys& keys : {far, frames, bounces}) {
    const Bits bits = draw(lab, keys);
    // Nothing but 65536 pairs of bounce and dimension leaves its mark on half a word; paths use 65 by 4 of them.
    add_bit_tests(bits, chance, keys.along_x == kBounce ? 16 : 8);
    add_pair_tests(bits, chance);
    std::set<std::array<uint32_t, 4>> seen;
    for (size_t k = 0; k < bits[0].size(); ++k) seen.insert({bits[0][k], bits[1][k], bits[2][k], bits[3][k]});
    repeated += bits[0].size() - seen.size();
  }
  return {chance.figure("pixels to 65535, frames to 2^32 - 1, 256 bounces by 256 dimensions"),
          none("keys with the same 128 bits", static_cast<double>(repeated)),
          at_most("last frame before the number wraps, and the first after it",
                  sigmas(draw(lab, frames), draw(lab, moved(frames, kFrame, 4096))), 3, "standard deviations")};
}

}  // namespace

void add_random_checks(std::vector<Check>& checks) {
  const std::string group = "random numbers";
  checks.push_back({.name = "uniform_floats",
                    .group = group,
                    .extreme = "32 random bits that are all ones",
                    .danger = "bits * 2^-32 rounds to 1 in 32-bit floats, outside [0, 1)",
                    .guard = "24 bits are kept: shaders/lib/random.glsl, uniform_floats",
                    .measure = measure_uniform_floats});
  checks.push_back({.name = "random_uniformity",
                    .group = group,
                    .extreme = "each bit and pairs of numbers over pixels, frames, paths and seeds",
                    .danger = "fract(sin(dot)) gives 1626 distinct values to 10000 points, 28 of them at 1000 km",
                    .guard = "pcg4d over pixel, frame, bounce, dimension, path and seed: shaders/lib/random.glsl",
                    .measure = measure_uniformity});
  checks.push_back({.name = "random_autocorrelation",
                    .group = group,
                    .extreme = "numbers of neighbouring pixels, frames, paths, bounces and dimensions",
                    .danger = "noise that stays, which no filter removes and no number of frames averages out",
                    .guard = "every word of the key goes through all rounds of the hash: shaders/lib/random.glsl",
                    .measure = measure_autocorrelation});
  checks.push_back({.name = "random_seeds",
                    .group = group,
                    .extreme = "seeds that differ by 1, 2, 4 to 2^31",
                    .danger = "runs that are taken for independent share their noise",
                    .guard = "the seed is a word of the key, not an offset, its upper half folded into the lower: "
                             "shaders/lib/random.glsl, random_bits",
                    .measure = measure_seeds});
  checks.push_back({.name = "random_far_keys",
                    .group = group,
                    .extreme = "pixels up to 65535, frames up to 2^32 - 1, 255 bounces, path 65535",
                    .danger = "words of the key that overlap give two decisions the same numbers",
                    .guard = "packing of the key's words without overlap: shaders/lib/random.glsl, random_bits",
                    .measure = measure_far_keys});
}

}  // namespace lightloom::stability
