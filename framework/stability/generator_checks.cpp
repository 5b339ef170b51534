#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"
#include "framework/stability/statistics.hpp"

namespace lightloom::stability {
namespace {

/// Shaders with Philox in place of the hash that is shipped.
run::ShaderFolders other_generator(run::ShaderFolders folders) {
  std::vector<std::filesystem::path> sources;
  for (const std::filesystem::path& folder : folders.sources) sources.push_back(folder / "stability" / "philox");
  folders.sources.insert(folders.sources.begin(), sources.begin(), sources.end());
  return folders;
}

/// Four words of a key that is all zero.
std::array<uint32_t, 4> first_words(Lab& lab) {
  const image::HostImage bits =
      lab.last_frame(R"({ "lightloom": 1, "name": "first_words", "passes": { "bits": { "type": "compute",
        "shader": "stability/random_bits.comp", "out": { "bits": { "format": "rgba32_uint", "size": "1x1" } },
        "params": { "pixel_x": 0, "pixel_y": 0, "frame_low": 0, "frame_high": 0, "path": 0, "bounce": 0, "dimension": 0,
                    "seed_low": 0, "seed_high": 0, "along_x": 0, "along_y": 1, "step_x": 1, "step_y": 1 } } },
        "outputs": { "bits": "bits.bits" } })",
                     lamp_room())
          .at("bits");
  std::array<uint32_t, 4> words{};
  for (uint32_t word = 0; word < 4; ++word) words.at(word) = static_cast<uint32_t>(bits.at(0, 0, 0, word));
  return words;
}

/// Means of each quarter of the picture over the frames.
std::array<SampleMean, 4> quarter_means(Lab& lab, const TraceOptions& options) {
  std::array<SampleMean, 4> means;
  const uint32_t half = options.size / 2;
  for (const Images& images : trace(lab, room_of_all_lights(), options))
    for (uint32_t quarter = 0; quarter < 4; ++quarter) {
      double sum = 0;
      for (uint32_t y = 0; y < half; ++y)
        for (uint32_t x = 0; x < half; ++x)
          sum += images.at("radiance").at(x + half * (quarter % 2), y + half * (quarter / 2), 0, 1);
      means.at(quarter).add(sum);
    }
  return means;
}

std::vector<Figure> measure_generators(Lab& lab) {
  Lab other(lab.device(), lab.registry(), other_generator(lab.shaders()));
  // Known answer of the authors' distribution for a counter and a key of 0.
  const std::array<uint32_t, 4> known{0x6627E8D5u, 0xE169C58Du, 0xBC57AC4Cu, 0x9B00DBD8u};
  const std::array<uint32_t, 4> own = first_words(lab), words = first_words(other);
  double off = 0, same = 0;
  for (size_t word = 0; word < 4; ++word) {
    off += words.at(word) != known.at(word) ? 1 : 0;
    same += words.at(word) == own.at(word) ? 1 : 0;
  }
  std::vector<Figure> figures = {none("words off the other generator's known answer", off),
                                 none("words that both generators share", same)};
  for (const bool faces : {false, true}) {
    TraceOptions options{.params = R"("paths": 2, "bounces": 2)", .frames = 14};
    options.faces = faces;
    const std::array<SampleMean, 4> a = quarter_means(lab, options), b = quarter_means(other, options);
    double z = 0, error = 0;
    for (size_t quarter = 0; quarter < 4; ++quarter) {
      const double both = std::hypot(a.at(quarter).error(), b.at(quarter).error());
      z = std::max(z, std::abs(a.at(quarter).mean() - b.at(quarter).mean()) / both);
      error = std::max(error, both / a.at(quarter).mean());
    }
    const std::string which = faces ? ", lamp by faces" : ", lamp by hints";
    figures.push_back(
        at_most("means of the quarters of a picture, the largest difference" + which, z, 3, "standard errors"));
    figures.push_back(at_most("standard error of those" + which, error, 0.02, "relative"));
  }
  return figures;
}

}  // namespace

void add_generator_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "random numbers");
  add("other_generator", "Philox4x32-10 in place of pcg4d: pictures of the same mean",
      "light that is right only with the numbers of one generator",
      "a decision takes numbers by what it is for, not by how they are made: shaders/lib/random.glsl",
      measure_generators);
}

}  // namespace lightloom::stability
