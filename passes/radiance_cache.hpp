#pragma once

#include <string>

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// An optional input for the light of a radiance_cache, as large as the input `voxels`.
[[nodiscard]] Port cached_light_input(std::string name, const std::string& doc);

/// See the doc string of the pass type.
[[nodiscard]] PassType make_radiance_cache();

}  // namespace lightloom::passes
