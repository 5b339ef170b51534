#include "framework/study/graph_layout.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "framework/study/graph_layers.hpp"

namespace lightloom::study {
namespace {

using Edge = GraphLayout::Edge;

constexpr double kMargin = 22;
constexpr double kBoxHeight = 40;
constexpr double kLayerGap = 34;      // between boxes of neighbouring layers
constexpr double kNodeGap = 18;       // between boxes of one layer
constexpr double kNameWidth = 7.3;    // of a character of the name, 12 px monospace
constexpr double kTypeWidth = 6.1;    // of the type below it, 10 px
constexpr double kLaneWidth = 13;     // between lanes of history
constexpr double kHistoryShift = 10;  // beside the edges within a frame
constexpr double kLongestName = 28;   // characters; longer names are cut where they are drawn

double box_width(const StudyResults::DrawnPass& pass) {
  const double name = std::min(static_cast<double>(pass.name.size()), kLongestName) * kNameWidth;
  const double type = std::min(static_cast<double>(pass.type.size()), kLongestName) * kTypeWidth;
  return std::round(std::max({name, type, 56.0}) + 24);
}

std::string ages_text(uint32_t lowest, uint32_t highest) {
  std::string text = "@" + std::to_string(lowest);
  if (highest > lowest) text += ".." + std::to_string(highest);
  return text;
}

/// Edges between the same passes become one, history apart.
std::vector<Edge> group_edges(const std::vector<StudyResults::DrawnPass>& passes,
                              const std::vector<StudyResults::DrawnEdge>& drawn) {
  std::map<std::string, size_t> index;
  for (size_t i = 0; i < passes.size(); ++i) index.emplace(passes[i].name, i);
  struct Ages {
    uint32_t lowest = 0;
    uint32_t highest = 0;
  };
  std::map<std::tuple<size_t, size_t, bool>, size_t> known;
  std::vector<Edge> edges;
  std::vector<Ages> ages;
  for (const auto& edge : drawn) {
    const auto from = index.find(edge.from);
    const auto to = index.find(edge.to);
    const bool history = edge.age > 0;
    if (from == index.end() || to == index.end() || (!history && from->second >= to->second)) continue;
    const auto [entry, made] = known.emplace(std::make_tuple(from->second, to->second, history), edges.size());
    if (made) {
      Edge grouped;
      grouped.from = from->second;
      grouped.to = to->second;
      grouped.history = history;
      edges.push_back(grouped);
      ages.push_back({edge.age, edge.age});
    }
    Edge& grouped = edges[entry->second];
    Ages& range = ages[entry->second];
    range = {std::min(range.lowest, edge.age), std::max(range.highest, edge.age)};
    if (history) grouped.ages = ages_text(range.lowest, range.highest);
    const bool seen = std::find(grouped.labels.begin(), grouped.labels.end(), edge.label) != grouped.labels.end();
    if (!edge.label.empty() && !seen) grouped.labels.push_back(edge.label);
  }
  return edges;
}

double top_of(uint32_t layer) {
  return kMargin + layer * (kBoxHeight + kLayerGap);
}

struct Point {
  double x = 0;
  double y = 0;
};

/// Tenths of pixels, so that the text is short and the same everywhere.
std::string number(double value) {
  const long tenths = std::lround(value * 10);
  std::string text = (tenths < 0 ? "-" : "") + std::to_string(std::labs(tenths) / 10);
  if (tenths % 10 != 0) text += "." + std::to_string(std::labs(tenths) % 10);
  return text;
}

std::string text(Point p) {
  return number(p.x) + " " + number(p.y);
}

std::string curve_down(Point from, Point to) {
  const double middle = (from.y + to.y) / 2;
  return "C" + text({from.x, middle}) + " " + text({to.x, middle}) + " " + text(to);
}

/// Through the layers' gaps by curves, straight down past boxes.
std::string route_down(const GraphLayout& layout, const LayeredGraph& graph, const std::vector<size_t>& route,
                       double entry, double shift) {
  const auto& first = layout.boxes[route.front()];
  Point at{first.x + first.width / 2 + shift, first.y + first.height};
  std::string path = "M" + text(at);
  for (size_t i = 1; i + 1 < route.size(); ++i) {
    const auto& joint = graph.nodes[route[i]];
    const Point top{joint.centre + shift / 2, top_of(joint.layer)};
    at = {top.x, top.y + kBoxHeight};
    path += curve_down({i == 1 ? first.x + first.width / 2 + shift : graph.nodes[route[i - 1]].centre + shift / 2,
                        top.y - kLayerGap},
                       top) +
            "V" + number(at.y);
  }
  return path + curve_down(at, {entry, layout.boxes[route.back()].y});
}

/// Out of the bottom, along the gap to the lane, up, and into the top.
std::string route_up(const GraphLayout::Box& from, const GraphLayout::Box& to, double lane, double dip) {
  const double out = from.x + from.width * 0.75;
  const double in = to.x + to.width * 0.82;
  const double below = from.y + from.height + dip;
  const double above = to.y - dip;
  const double round = 5;
  std::ostringstream path;
  path << "M" << text({out, from.y + from.height}) << "V" << number(below - round) << "Q" << text({out, below}) << " "
       << text({out + round, below}) << "H" << number(lane - round) << "Q" << text({lane, below}) << " "
       << text({lane, below - round}) << "V" << number(above + round) << "Q" << text({lane, above}) << " "
       << text({lane - round, above}) << "H" << number(in + round) << "Q" << text({in, above}) << " "
       << text({in, above + round}) << "V" << number(to.y);
  return path.str();
}

/// Indices of edges that go down with the others, and of those of history that climb in lanes.
struct Directions {
  std::vector<size_t> down;
  std::vector<size_t> up;
};

Directions split(const std::vector<Edge>& edges) {
  Directions directions;
  for (size_t i = 0; i < edges.size(); ++i)
    (edges[i].from < edges[i].to ? directions.down : directions.up).push_back(i);
  return directions;
}

/// Moves all nodes so that the leftmost begins at the margin; returns the right end of the rightmost.
double align_left(LayeredGraph& graph) {
  double left = 0;
  double right = 0;
  for (size_t i = 0; i < graph.nodes.size(); ++i) {
    const double low = graph.nodes[i].centre - graph.nodes[i].width / 2;
    left = i == 0 ? low : std::min(left, low);
  }
  for (auto& node : graph.nodes) {
    node.centre += kMargin - left;
    right = std::max(right, node.centre + node.width / 2);
  }
  return right;
}

/// Edges enter a pass side by side, from left to right as they come.
void draw_down(GraphLayout& layout, const LayeredGraph& graph, const std::vector<size_t>& down) {
  std::vector<std::vector<std::pair<double, size_t>>> arrivals(layout.boxes.size());
  for (size_t k = 0; k < down.size(); ++k) {
    const auto& route = graph.routes[k];
    const double shift = layout.edges[down[k]].history ? kHistoryShift : 0;
    arrivals[route.back()].emplace_back(graph.nodes[route[route.size() - 2]].centre + shift, k);
  }
  for (size_t pass = 0; pass < layout.boxes.size(); ++pass) {
    std::sort(arrivals[pass].begin(), arrivals[pass].end());
    const auto& box = layout.boxes[pass];
    const auto count = static_cast<double>(arrivals[pass].size());
    const double step = std::min(22.0, box.width * 0.6 / std::max(count, 1.0));
    for (size_t i = 0; i < arrivals[pass].size(); ++i) {
      const size_t k = arrivals[pass][i].second;
      Edge& edge = layout.edges[down[k]];
      const double entry = box.x + box.width / 2 + (static_cast<double>(i) - (count - 1) / 2) * step;
      edge.path = route_down(layout, graph, graph.routes[k], entry, edge.history ? kHistoryShift : 0);
      edge.label_x = entry + 4;
      edge.label_y = box.y - 5;
    }
  }
}

/// Returns the right end of the last lane.
double draw_up(GraphLayout& layout, const std::vector<size_t>& up, double right) {
  double lane = right + kLaneWidth;
  for (size_t i = 0; i < up.size(); ++i) {
    Edge& edge = layout.edges[up[i]];
    const double dip = 9 + 3 * static_cast<double>(i % 3);
    edge.path = route_up(layout.boxes[edge.from], layout.boxes[edge.to], lane, dip);
    edge.label_x = lane + 3;
    edge.label_y = (layout.boxes[edge.from].y + layout.boxes[edge.to].y + kBoxHeight) / 2 + 4;
    lane += kLaneWidth + static_cast<double>(edge.ages.size()) * kTypeWidth;
  }
  return up.empty() ? right : lane - kLaneWidth;
}

}  // namespace

GraphLayout lay_out(const std::vector<StudyResults::DrawnPass>& passes,
                    const std::vector<StudyResults::DrawnEdge>& drawn) {
  GraphLayout layout;
  if (passes.empty()) return layout;
  layout.edges = group_edges(passes, drawn);
  const Directions directions = split(layout.edges);

  std::vector<double> widths;
  for (const auto& pass : passes) widths.push_back(box_width(pass));
  std::vector<std::pair<size_t, size_t>> down;
  for (const size_t i : directions.down) down.emplace_back(layout.edges[i].from, layout.edges[i].to);
  LayeredGraph graph = make_layers(widths, down);
  order_layers(graph);
  place_nodes(graph, kNodeGap);
  const double right = align_left(graph);

  for (size_t i = 0; i < passes.size(); ++i) {
    const auto& node = graph.nodes[i];
    layout.boxes.push_back({node.centre - widths[i] / 2, top_of(node.layer), widths[i], kBoxHeight, node.layer});
  }
  draw_down(layout, graph, directions.down);
  layout.width = draw_up(layout, directions.up, right) + kMargin;
  layout.height = top_of(static_cast<uint32_t>(graph.layers.size())) - kLayerGap + kMargin;
  return layout;
}

}  // namespace lightloom::study
