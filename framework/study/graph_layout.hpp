#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/study/results.hpp"

namespace lightloom::study {

/// Where passes and edges stand in a drawing, in CSS pixels, y downwards.
struct GraphLayout {
  struct Box {
    double x = 0;  ///< left
    double y = 0;  ///< top
    double width = 0;
    double height = 0;
    uint32_t layer = 0;
  };
  /// All values that go from one pass to another within a frame, or all of earlier frames.
  struct Edge {
    size_t from = 0;  ///< index in StudyResults::graph_passes
    size_t to = 0;
    bool history = false;
    std::string ages;                 ///< "@1", "@1..9"; empty within a frame
    std::vector<std::string> labels;  ///< ports, each once
    std::string path;                 ///< SVG path data
    double label_x = 0;               ///< where `ages` is written
    double label_y = 0;
  };
  double width = 0;
  double height = 0;
  std::vector<Box> boxes;  ///< by index in StudyResults::graph_passes
  std::vector<Edge> edges;
};

/// Layered drawing (Sugiyama, Tagawa and Toda 1981): within a frame each edge leads down by at least one layer, boxes
/// do not overlap, edges that leave one pass share a trunk. Edges of history that lead up, or to the pass itself, run
/// in lanes on the right. Passes must stand in execution order; edges that name an unknown pass, or that lead up within
/// a frame, are left out.
[[nodiscard]] GraphLayout lay_out(const std::vector<StudyResults::DrawnPass>& passes,
                                  const std::vector<StudyResults::DrawnEdge>& edges);

}  // namespace lightloom::study
