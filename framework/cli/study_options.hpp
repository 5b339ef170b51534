#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/cli/argument_parser.hpp"
#include "framework/cli/cache_option.hpp"
#include "framework/cli/limit_options.hpp"
#include "framework/study/study_spec.hpp"

namespace lightloom::cli {

/// The command line of `lightloom study`.
struct StudyOptions {
  std::filesystem::path study;
  std::filesystem::path out;
  LimitOptions limits;
  CacheOption cache;
  std::optional<uint32_t> jobs;
  std::string device;
  bool fresh = false;
  bool dry_run = false;
  bool no_times = false;

  std::filesystem::path graph;
  std::vector<std::filesystem::path> scenes;
  std::vector<std::string> cameras;
  std::string ablate;
  bool factorial = false;
  std::vector<Assignment> sweeps;
  bool one_at_a_time = false;
  std::filesystem::path reference;
  std::vector<Assignment> reference_sets;
  std::optional<uint32_t> reference_frames;
  std::optional<uint32_t> seeds;
  std::optional<uint32_t> frames;
  std::optional<uint32_t> warm_up;
  std::string metrics;

  std::vector<std::string> variants;
  std::vector<Assignment> sets;
  std::vector<Assignment> stores;
  std::vector<std::string> disables;
  std::vector<Assignment> swaps;
  std::optional<Size> size;
  std::optional<Size> trace_size;
  bool general = false;

  void add_to(Command& command);
};

/// The study that is asked for: a file's with what the options change, or one made of options alone. Empty if
/// `diagnostics` has errors. Throws Error(usage) for options that do not go together.
[[nodiscard]] std::optional<study::StudySpec> study_spec(const StudyOptions& options, Diagnostics& diagnostics);

}  // namespace lightloom::cli
