#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/image/crop.hpp"
#include "framework/image/flicker.hpp"
#include "framework/image/metrics.hpp"
#include "framework/image/read_image.hpp"

namespace lightloom::cli {

struct ComparisonRequest {
  std::filesystem::path reference;  ///< a file, a run folder, or a pattern with a frame number
  std::filesystem::path test;
  std::string output = "radiance";  ///< of run folders
  image::ReadOptions read;
  std::optional<image::PixelBox> crop;
  std::optional<image::FlipKind> flip;  ///< by the kind of the files unless given
  image::MetricOptions metrics;         ///< its `flip` is not used
  std::filesystem::path heat_map;       ///< PNG; empty: none. For several frames, a pattern
  std::filesystem::path error_map;      ///< PNG or EXR; the same
};

struct ComparedFrame {
  uint32_t frame = 0;
  std::filesystem::path reference;
  std::filesystem::path test;
  image::Metrics metrics;
};

struct Comparison {
  bool sequence = false;
  Extent3 extent;
  image::FlipKind flip = image::FlipKind::hdr;
  bool reference_decoded = false;  ///< the transfer function of sRGB was removed
  bool test_decoded = false;
  std::vector<ComparedFrame> frames;  ///< one unless it is a sequence
  image::Flicker flicker;             ///< of the test; NaN for a single frame
  image::Flicker flicker_reference;
  std::vector<std::string> warnings;
};

/// Called after each frame with how many are done, and how many there are.
using ComparisonProgress = std::function<void(uint32_t done, uint32_t total)>;

/// Throws Error: invalid_input for what cannot be read or compared (it names the file), usage for options that do not
/// fit the number of frames, run_failed for maps that cannot be written.
[[nodiscard]] Comparison compare_files(const ComparisonRequest& request, const ComparisonProgress& progress);

}  // namespace lightloom::cli
