#pragma once

#include <cstdint>
#include <vector>

#include "framework/graph/graph.hpp"

namespace lightloom {

/// A layer of a value that somebody must give before the frame.
struct NeededLayer {
  ValueId value = 0;  ///< in Cut::graph
  uint32_t age = 0;   ///< 0: this frame's
  bool operator==(const NeededLayer&) const = default;
};

/// A part of a graph that can run a frame by itself.
struct Cut {
  Graph graph;
  std::vector<NeededLayer> needed;  ///< by value, then age
};

/// The chosen passes (one entry a pass of the graph) with all values that they touch. What another pass makes stands as
/// a constant, black, with as many layers as it had: to a plan its texels are nobody's, and they are given from outside
/// before the frame. Needed are the layers of those values, and of earlier frames of values that the chosen passes
/// make. Outputs and captures stay where the value is made by a chosen pass; what only others read becomes a capture,
/// so that it still is read. Constants stay. The cut of all passes is the graph itself.
[[nodiscard]] Cut cut(const Graph& graph, const std::vector<bool>& chosen);

/// The same graph for a frame that stands by itself: nothing is hoisted, and no pass finds its last work, so that each
/// runs and writes all that it has to.
[[nodiscard]] Graph for_one_frame(Graph graph);

}  // namespace lightloom
