#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lightloom::study {

/// A proper layered graph: nodes, then joints where an edge crosses a layer, so that each link leads one layer down.
struct LayeredGraph {
  static constexpr size_t kJoint = static_cast<size_t>(-1);
  struct Node {
    size_t pass = kJoint;  ///< kJoint for a joint
    uint32_t layer = 0;
    double width = 0;
    double centre = 0;          ///< x, set by place_nodes
    std::vector<size_t> above;  ///< linked nodes of the layer above
    std::vector<size_t> below;
  };
  std::vector<Node> nodes;                  ///< the passes first, by index
  std::vector<std::vector<size_t>> layers;  ///< nodes from left to right
  /// For each edge given: the nodes it passes, from its first pass to its last.
  std::vector<std::vector<size_t>> routes;
};

/// Layers of passes 0..count-1 by longest path; passes with more edges out than in sink towards what reads them.
/// Edges go from lower to higher index. Edges from one pass share their joints.
[[nodiscard]] LayeredGraph make_layers(const std::vector<double>& widths,
                                       const std::vector<std::pair<size_t, size_t>>& edges);

/// Orders each layer so that few links cross (barycentres, best of several sweeps).
void order_layers(LayeredGraph& graph);

/// How many pairs of links cross.
[[nodiscard]] size_t count_crossings(const LayeredGraph& graph);

/// Sets `centre` of all nodes, at least `gap` between neighbours, near what they are linked with.
void place_nodes(LayeredGraph& graph, double gap);

}  // namespace lightloom::study
