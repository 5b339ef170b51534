#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lightloom::study {

/// Mean of a figure over seeds with its 95 % confidence interval (Student's t); low = high = mean for one seed, where
/// nothing is known of the spread.
struct Estimate {
  double mean = 0;
  double low = 0;
  double high = 0;
  double standard_deviation = 0;
  uint32_t count = 0;
};

/// Times of frames after the warm-up [ms].
struct Timing {
  double median = 0;
  double p95 = 0;
};

struct PassTiming {
  std::string pass;
  Timing frame;     ///< of a pass that each frame runs
  double once = 0;  ///< of a hoisted pass [ms]; 0 for the others
  bool hoisted = false;
};

/// How a row stands to the study's first setting in the same scene and camera, by one metric.
struct Verdict {
  Estimate difference;       ///< row minus baseline, seed by seed
  double ratio = 1;          ///< of the means, row / baseline
  bool within_noise = true;  ///< the interval of the difference holds 0 (or one seed only)
};

/// One setting in one scene seen by one camera, over all seeds.
struct Row {
  std::string setting;  ///< "paper", "without denoise_tangent", "paths=4"
  std::string scene;
  std::string camera;
  std::vector<std::pair<std::string, std::string>> values;  ///< by axis of the study: {"paths", "4"}
  std::vector<std::string> command;                         ///< lightloom render …: reproduces one cell of the row
  std::vector<std::string> culled;  ///< passes that the baseline runs and this row does not, besides those disabled
  std::vector<std::string> disabled;
  std::string error;                        ///< why it could not be run; empty: it was, and the rest holds
  std::map<std::string, Estimate> metrics;  ///< by the names of `lightloom compare`, of linear radiance
  Estimate bias_squared;  ///< mean over pixels of (mean over seeds - reference)^2, corrected for the seeds' noise
  Estimate variance;      ///< mean over pixels of the seeds' variance
  std::map<std::string, Verdict> verdicts;  ///< by metric, "frame_ms" too; empty in the baseline's row
  Estimate frame_ms;                        ///< medians of frames, over seeds
  Timing frame;                             ///< over all timed frames of all seeds
  Timing wall;                              ///< of whole frames on the host, read-back included
  bool disturbed = false;                   ///< other cells ran at the same time: the times say little
  double once_ms = 0;                       ///< all hoisted passes
  double first_frame_ms = 0;                ///< wall time of the first frame, with pipelines made
  std::vector<PassTiming> passes;           ///< in execution order
  uint64_t memory_bytes = 0;
  bool pareto = false;  ///< no other row of the scene and camera is both faster and better (study's first metric)
  std::filesystem::path picture;   ///< PNG of the first seed, relative to the study's folder
  std::filesystem::path heat_map;  ///< PNG of FLIP against the reference, the same for all rows
};

/// A row that reaches what another one costs.
struct TradeEntry {
  std::string scene;
  std::string camera;
  std::string setting;
  double target = 0;  ///< milliseconds (equal time) or the metric (equal error) aimed at
  double milliseconds = 0;
  double error = 0;  ///< by the study's first metric
  std::string note;  ///< "interpolated between paths=4 and paths=8", …
};

struct View {
  std::string scene;
  std::string camera;
  std::filesystem::path reference;  ///< PNG, relative to the study's folder
  double reference_relmse = 0;      ///< the reference's own estimate of its noise, as relMSE; 0 where unknown
  std::string reference_note;       ///< how it was made: "reference_path_trace, triangles, 1024 paths"
};

struct StudyResults {
  std::string name;
  std::string description;
  std::string graph;              ///< file
  std::string metric;             ///< the first, by which rows are ranked: "flip"
  std::vector<std::string> axes;  ///< names of what varies
  std::vector<std::pair<std::string, std::string>>
      provenance;                  ///< device, driver, version, commit, seeds, frames, sizes
  std::vector<std::string> notes;  ///< what a reader must know: times disturbed, one seed alone, no reference, ...
  std::vector<View> views;
  std::vector<Row> rows;
  std::vector<TradeEntry> equal_time;
  std::vector<TradeEntry> equal_error;
  /// The baseline's graph for drawing: passes in execution order, edges between them (history edges with their age).
  struct DrawnPass {
    std::string name;
    std::string type;
    bool hoisted = false;
  };
  struct DrawnEdge {
    std::string from;
    std::string to;
    std::string label;  ///< ports
    uint32_t age = 0;
  };
  std::vector<DrawnPass> graph_passes;
  std::vector<DrawnEdge> graph_edges;
};

}  // namespace lightloom::study
