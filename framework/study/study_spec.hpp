#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/graph/link.hpp"

namespace lightloom::study {

/// Width and height [pixels].
using Size = std::pair<uint32_t, uint32_t>;

/// What is done to a graph. Later ones win where both say the same.
struct Changes {
  std::vector<std::string> variants;
  std::vector<std::pair<std::string, std::string>> swaps;    ///< pass glob, type
  std::vector<std::string> disables;                         ///< pass globs
  std::vector<std::pair<std::string, std::string>> sets;     ///< "PARAM" or "PASS.PARAM", value text
  std::vector<std::pair<std::string, std::string>> formats;  ///< glob over values, name of a format
  std::optional<Size> size;
  std::optional<Size> trace_size;
  std::optional<bool> general;  ///< LinkOptions::general
};

/// `first`, then `second`.
[[nodiscard]] Changes combine(Changes first, const Changes& second);
[[nodiscard]] LinkOptions link_options(const Changes& changes);
/// The changes as options of `lightloom render`, in the order in which they are applied.
[[nodiscard]] std::vector<std::string> command_options(const Changes& changes);

/// One value of an axis, or one of the study's variants.
struct Choice {
  std::string name;
  Changes changes;
  SourceLocation where;
};

struct Axis {
  std::string name;
  std::vector<Choice> choices;  ///< at least one; the first is the baseline's
  SourceLocation where;
};

struct SceneChoice {
  std::filesystem::path file;
  std::vector<std::string> cameras;  ///< empty: the scene's first
};

/// What errors are measured against.
struct ReferenceSpec {
  enum class Kind : uint8_t {
    baseline,  ///< none given: the baseline, averaged
    graph,     ///< another graph file
    image,     ///< a picture made elsewhere
    setting,   ///< the study's graph with other changes
  };
  Kind kind = Kind::baseline;
  std::filesystem::path graph;
  std::string image;  ///< file, where {scene}, {camera}, {size} and {frame} stand for the view's
  Changes changes;
  uint32_t frames = 1;
  uint32_t seed = 0x5eed;
  bool average = false;            ///< over the frames, whose mean is the reference; else the last of them is
  std::vector<std::string> match;  ///< params that the reference takes over from the setting that is judged
  SourceLocation where;
};

/// A study: every setting in every view with every seed. Paths are as they can be opened.
struct StudySpec {
  std::filesystem::path file;  ///< empty: made from a command line
  std::string name;
  std::string description;
  std::filesystem::path graph;
  std::vector<SceneChoice> scenes;
  Changes changes;  ///< of all settings
  uint32_t first_frame = 0;
  uint32_t frames = 10;  ///< a cell
  uint32_t warm_up = 2;  ///< so many frames at first are not timed
  uint32_t judged = 1;   ///< so many frames at last are compared with the reference
  double frames_per_second = 30;
  std::vector<uint32_t> seeds = {0};
  std::vector<Choice> variants;
  std::vector<std::string> ablate;  ///< pass globs
  SourceLocation ablate_where;
  bool factorial = false;
  std::vector<Axis> sweep;
  bool crossed = true;  ///< else one axis at a time
  ReferenceSpec reference;
  std::vector<std::string> metrics;  ///< the first ranks; empty: all
  std::string output = "radiance";   ///< of the graph: what is judged
  uint32_t jobs = 1;
};

/// Reads a study's text, reporting every problem: unknown keys, wrong types, values out of range, each with its place.
/// Empty if there is any. `file` is for messages, and paths in the study are relative to its folder. Never throws.
[[nodiscard]] std::optional<StudySpec> parse_study(std::string_view text, const std::filesystem::path& file,
                                                   Diagnostics& diagnostics);

/// "WIDTHxHEIGHT".
[[nodiscard]] std::optional<Size> parse_size(std::string_view text);
[[nodiscard]] std::string size_text(const Size& size);

/// Names that `metrics` may hold, those of `lightloom compare --json`; the default order.
[[nodiscard]] const std::vector<std::string>& metric_names();

constexpr uint32_t kMostFrames = 100'000;
constexpr uint32_t kMostSeeds = 1'000;
constexpr uint32_t kMostJobs = 64;

}  // namespace lightloom::study
