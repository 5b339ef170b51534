#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// See the doc string of the pass type.
[[nodiscard]] PassType make_empty_boxes();

}  // namespace lightloom::passes
