#pragma once

#include "framework/graph/graph.hpp"

namespace lightloom {

/// Finds the passes that give the same result in every frame and says why in GraphPass::once: they read nothing that is
/// `changing`, all their inputs are this frame's values of such passes or constants, they have no side effect, and no
/// history of their outputs is kept (the frames before the first one are black in it). What such a pass writes is not
/// persistent, as it is written once.
void hoist(Graph& graph, FrameState changing);

}  // namespace lightloom
