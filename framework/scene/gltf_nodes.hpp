#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/base/limits.hpp"
#include "framework/scene/accessor.hpp"
#include "framework/scene/source.hpp"

namespace lightloom::scene {

/// The nodes of a file in an order in which parents come first. Throws Error unless each node has at most one parent,
/// there is no cycle, scenes list root nodes, each once, and no node lies deeper than Limits::node_depth.
struct NodeOrder {
  std::vector<int> parents;  ///< by node of the file; -1: root
  std::vector<int> order;    ///< nodes of the file, parents first
  std::vector<int> drawn;    ///< nodes of the default scene (all nodes if the file has no scene), in depth-first order
};
[[nodiscard]] NodeOrder order_nodes(const GltfFile& file, const Limits& limits);

/// Node `index` at rest; `parent` is left at -1. Throws Error for a transform that is not one.
[[nodiscard]] SourceNode load_node(const GltfFile& file, int index);

/// Joints are nodes of the file. Throws Error.
[[nodiscard]] SourceSkin load_skin(const GltfFile& file, const AccessorReader& reader, int index);

/// An animation of the file; `duration` may be 0. Track nodes are nodes of the file. `morph_targets` is
/// count_morph_targets of the file. Throws Error.
[[nodiscard]] Clip load_animation(const GltfFile& file, const AccessorReader& reader,
                                  const std::vector<size_t>& morph_targets, int index);

/// Number of morph targets of each mesh; throws Error if primitives of one mesh differ.
[[nodiscard]] std::vector<size_t> count_morph_targets(const GltfFile& file);

/// Whether a track changes anything over time.
[[nodiscard]] bool is_constant(const Track& track);

}  // namespace lightloom::scene
