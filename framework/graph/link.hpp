#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/pass_type.hpp"

namespace lightloom {

/// A param of all passes of a type, whatever their names.
struct TypeSet {
  std::string option;  ///< that asked for it, the place of its errors: "--geometry"
  std::string type;
  std::string param;
  std::string value;
};

/// What the command line asks for. Applied in this order: each variant in turn (its swap, disable, set, formats), then
/// `swaps`, `type_sets`, `disables`, `sets`, `formats`. Problems are reported at file "--variant", "--swap",
/// "--disable", "--set",
/// "--store", "--dump", "--size", "--trace-size", line 0.
struct LinkOptions {
  std::vector<std::string> variants;
  std::vector<std::pair<std::string, std::string>> swaps;  ///< pass glob, type
  std::vector<TypeSet> type_sets;                          ///< each needs a pass of its type
  std::vector<std::string> disables;                       ///< pass globs
  std::vector<std::pair<std::string, std::string>> sets;   ///< "PARAM" or "PASS.PARAM" (PASS a glob), value text
  /// Glob over "pass.port" and "pass.port.part", name of a format. Of several images those are stored so that can be.
  std::vector<std::pair<std::string, std::string>> formats;
  std::optional<std::pair<uint32_t, uint32_t>> view;   ///< width, height [pixels]
  std::optional<std::pair<uint32_t, uint32_t>> trace;  ///< the same of what is traced
  std::vector<std::string> captures;  ///< globs over "pass.port" and "pass.port.part"; "*" means every value
  bool hoist = true;                  ///< a pass whose result is the same in every frame runs in the first one alone
  bool general = false;  ///< as if the scene had every feature, and all of it changed: no `when` fails, shaders are
                         ///< not specialised, nothing is hoisted. For measuring what that gains
};

/// What the graph is linked against.
struct LinkEnvironment {
  /// Extent of the voxel grid at a resolution; a cube of that edge where empty.
  std::function<Extent3(int64_t resolution)> grid_extent;
  /// Every known feature of a scene, and whether this scene has it; `when` may name these alone.
  std::vector<std::pair<std::string, bool>> scene_features;
  /// What differs between two frames of the scene: dynamic geometry does not where there is none.
  FrameState changing = kChangingState;
};

/// Resolves names, params, bypasses and shapes, and culls. Reports every problem; empty if `diagnostics` has an error,
/// those of parse_graph included.
[[nodiscard]] std::optional<Graph> link(const GraphSpec& spec, const PassRegistry& registry, const LinkOptions& options,
                                        const LinkEnvironment& environment, Diagnostics& diagnostics);

}  // namespace lightloom
