#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Rasterised G-buffer at view size.
[[nodiscard]] PassType make_gather();

}  // namespace lightloom::passes
