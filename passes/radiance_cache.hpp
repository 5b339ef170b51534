#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Parts of the bundle `cached_light`: light on both sides of each voxel.
[[nodiscard]] std::vector<PortPart> cached_light_parts();

/// See the doc string of the pass type.
[[nodiscard]] PassType make_radiance_cache();

}  // namespace lightloom::passes
