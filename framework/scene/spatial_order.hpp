#pragma once

#include <cstdint>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// Reorders indices of triangles so that each half of the list, and of each half again down to single triangles, is
/// what lies on one side of a median across its longest extent, by the centres of the triangles at time 0. A tree of
/// bounds that splits ranges in the middle is then a good one.
void order_in_space(const Scene& scene, std::vector<uint32_t>& triangles);

}  // namespace lightloom::scene
