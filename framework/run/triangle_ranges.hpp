#pragma once

#include <functional>
#include <vector>

#include "framework/graph/pass_context.hpp"

namespace lightloom::run {

/// Disjoint ranges of the triangles 0 to `count` - 1, in order and at most `limit` (at least 1), that hold every
/// triangle for which `wanted` is true, and as few others as so many ranges allow.
[[nodiscard]] std::vector<TriangleRange> ranges_of(uint32_t count, const std::function<bool(uint32_t)>& wanted,
                                                   size_t limit);

}  // namespace lightloom::run
