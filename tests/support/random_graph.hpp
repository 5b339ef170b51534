#pragma once

#include <cstdint>
#include <string>

namespace lightloom::toy {

/// A graph file of the toy pass types that links: `passes` passes, with history edges in any direction, own history,
/// bundles, raster passes, optional inputs and disabled passes that have a bypass.
[[nodiscard]] std::string random_graph(uint32_t seed, int passes);

}  // namespace lightloom::toy
