#include "framework/scene/source.hpp"

#include <algorithm>
#include <map>

namespace lightloom::scene {

SceneSource part_of_clip(const SceneSource& source, const Clip& clip) {
  const int32_t first = clip.first_node;
  const int32_t end = first + clip.node_count;
  SceneSource part;
  part.origin = source.origin;
  part.nodes.assign(source.nodes.begin() + first, source.nodes.begin() + end);
  for (SourceNode& node : part.nodes)
    if (node.parent >= 0) node.parent -= first;
  for (Track& track : part.clips.emplace_back(clip).tracks) track.node -= first;
  part.clips.front().first_node = 0;
  // Draws stand in the order of the instances, as nodes do.
  const auto begins = [](int32_t node) { return [node](const Draw& draw) { return draw.node < node; }; };
  const auto low = std::partition_point(source.draws.begin(), source.draws.end(), begins(first));
  part.draws.assign(low, std::partition_point(low, source.draws.end(), begins(end)));
  std::map<int32_t, int32_t> skins;
  for (Draw& draw : part.draws) {
    draw.node -= first;
    if (draw.skin < 0) continue;
    const auto [found, added] = skins.emplace(draw.skin, static_cast<int32_t>(part.skins.size()));
    if (added) part.skins.push_back(source.skins[static_cast<size_t>(draw.skin)]);
    draw.skin = found->second;
  }
  for (SourceSkin& skin : part.skins)
    for (int32_t& joint : skin.joints) joint -= first;
  return part;
}

}  // namespace lightloom::scene
