#include "framework/study/graph_layers.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace lightloom::study {
namespace {

using Node = LayeredGraph::Node;

constexpr double kJointWidth = 12;
constexpr int kSweeps = 12;

std::vector<uint32_t> assign_layers(size_t count, const std::vector<std::pair<size_t, size_t>>& edges) {
  std::vector<std::vector<size_t>> into(count);
  std::vector<std::vector<size_t>> out(count);
  for (const auto& [from, to] : edges) {
    into[to].push_back(from);
    out[from].push_back(to);
  }
  std::vector<uint32_t> layer(count, 0);
  for (size_t node = 0; node < count; ++node) {
    for (const size_t from : into[node]) layer[node] = std::max(layer[node], layer[from] + 1);
  }
  for (size_t node = count; node-- > 0;) {
    if (out[node].empty() || out[node].size() < into[node].size()) continue;
    uint32_t lowest = std::numeric_limits<uint32_t>::max();
    for (const size_t to : out[node]) lowest = std::min(lowest, layer[to] - 1);
    layer[node] = lowest;
  }
  return layer;
}

size_t crossings_below(const LayeredGraph& graph, const std::vector<size_t>& layer,
                       const std::vector<size_t>& position) {
  std::vector<size_t> ends;  // of links, by start from left to right
  for (const size_t node : layer) {
    std::vector<size_t> below;
    for (const size_t next : graph.nodes[node].below) below.push_back(position[next]);
    std::sort(below.begin(), below.end());
    ends.insert(ends.end(), below.begin(), below.end());
  }
  size_t count = 0;
  for (size_t i = 0; i < ends.size(); ++i) {
    for (size_t j = i + 1; j < ends.size(); ++j) count += ends[j] < ends[i] ? 1 : 0;
  }
  return count;
}

std::vector<size_t> positions(const LayeredGraph& graph) {
  std::vector<size_t> position(graph.nodes.size(), 0);
  for (const auto& layer : graph.layers) {
    for (size_t i = 0; i < layer.size(); ++i) position[layer[i]] = i;
  }
  return position;
}

void sort_by_barycentre(LayeredGraph& graph, std::vector<size_t>& layer, bool by_above) {
  const std::vector<size_t> position = positions(graph);
  std::vector<double> key(graph.nodes.size(), 0);
  for (const size_t node : layer) {
    const auto& linked = by_above ? graph.nodes[node].above : graph.nodes[node].below;
    double sum = 0;
    for (const size_t other : linked) sum += static_cast<double>(position[other]);
    key[node] = linked.empty() ? static_cast<double>(position[node]) : sum / static_cast<double>(linked.size());
  }
  std::stable_sort(layer.begin(), layer.end(), [&](size_t a, size_t b) { return key[a] < key[b]; });
}

/// Nearest positions (least squares) to `wished` with x[i+1] - x[i] >= distance[i]: after taking the distances off this
/// is isotonic regression, solved by pooling neighbours that stand in the wrong order.
std::vector<double> keep_apart(const std::vector<double>& wished, const std::vector<double>& distance) {
  struct Pool {
    double sum = 0;
    size_t count = 0;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  std::vector<double> offset(wished.size(), 0);
  for (size_t i = 0; i < wished.size(); ++i) {
    if (i > 0) offset[i] = offset[i - 1] + distance[i - 1];
    pools.push_back({wished[i] - offset[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::vector<double> result;
  for (const Pool& pool : pools) {
    for (size_t k = 0; k < pool.count; ++k) result.push_back(pool.mean() + offset[result.size()]);
  }
  return result;
}

double mean_centre(const LayeredGraph& graph, const std::vector<size_t>& linked) {
  double sum = 0;
  for (const size_t other : linked) sum += graph.nodes[other].centre;
  return sum / static_cast<double>(linked.size());
}

void place_layer(LayeredGraph& graph, const std::vector<size_t>& layer, double gap, bool by_above) {
  std::vector<double> wished;
  std::vector<double> distance;
  for (size_t i = 0; i < layer.size(); ++i) {
    const Node& node = graph.nodes[layer[i]];
    const auto& linked = by_above ? node.above : node.below;
    wished.push_back(linked.empty() ? node.centre : mean_centre(graph, linked));
    if (i > 0) distance.push_back((graph.nodes[layer[i - 1]].width + node.width) / 2 + gap);
  }
  const std::vector<double> centres = keep_apart(wished, distance);
  for (size_t i = 0; i < layer.size(); ++i) graph.nodes[layer[i]].centre = centres[i];
}

}  // namespace

LayeredGraph make_layers(const std::vector<double>& widths, const std::vector<std::pair<size_t, size_t>>& edges) {
  const std::vector<uint32_t> layer = assign_layers(widths.size(), edges);
  LayeredGraph graph;
  for (size_t i = 0; i < widths.size(); ++i) graph.nodes.push_back({i, layer[i], widths[i], 0, {}, {}});
  std::map<std::pair<size_t, uint32_t>, size_t> joints;  // by pass that the edge leaves, and layer
  std::map<std::pair<size_t, size_t>, bool> linked;
  const auto link = [&](size_t above, size_t below) {
    if (!linked.emplace(std::make_pair(above, below), true).second) return;
    graph.nodes[above].below.push_back(below);
    graph.nodes[below].above.push_back(above);
  };
  for (const auto& [from, to] : edges) {
    std::vector<size_t> route{from};
    for (uint32_t at = layer[from] + 1; at < layer[to]; ++at) {
      const auto [joint, made] = joints.emplace(std::make_pair(from, at), graph.nodes.size());
      if (made) graph.nodes.push_back({LayeredGraph::kJoint, at, kJointWidth, 0, {}, {}});
      route.push_back(joint->second);
    }
    route.push_back(to);
    for (size_t i = 1; i < route.size(); ++i) link(route[i - 1], route[i]);
    graph.routes.push_back(std::move(route));
  }
  for (size_t i = 0; i < graph.nodes.size(); ++i) {
    if (graph.layers.size() <= graph.nodes[i].layer) graph.layers.resize(graph.nodes[i].layer + 1);
    graph.layers[graph.nodes[i].layer].push_back(i);
  }
  return graph;
}

size_t count_crossings(const LayeredGraph& graph) {
  const std::vector<size_t> position = positions(graph);
  size_t count = 0;
  for (const auto& layer : graph.layers) count += crossings_below(graph, layer, position);
  return count;
}

void order_layers(LayeredGraph& graph) {
  auto best = graph.layers;
  size_t fewest = count_crossings(graph);
  for (int sweep = 0; sweep < kSweeps && fewest > 0; ++sweep) {
    const bool down = sweep % 2 == 0;
    for (size_t i = 1; i < graph.layers.size(); ++i) {
      sort_by_barycentre(graph, graph.layers[down ? i : graph.layers.size() - 1 - i], down);
    }
    const size_t count = count_crossings(graph);
    if (count < fewest) {
      fewest = count;
      best = graph.layers;
    }
  }
  graph.layers = std::move(best);
}

void place_nodes(LayeredGraph& graph, double gap) {
  for (const auto& layer : graph.layers) {
    double right = 0;
    for (const size_t node : layer) {
      graph.nodes[node].centre = right + graph.nodes[node].width / 2;
      right += graph.nodes[node].width + gap;
    }
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const bool down = sweep % 2 == 0;
    for (size_t i = 1; i < graph.layers.size(); ++i) {
      place_layer(graph, graph.layers[down ? i : graph.layers.size() - 1 - i], gap, down);
    }
  }
}

}  // namespace lightloom::study
