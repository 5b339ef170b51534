#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::toy {

/// A few pass types with the names, ports and params of the real ones, but fixed, so that the expected diagnostics of
/// tests/graphs_bad do not move with the passes.
[[nodiscard]] const PassRegistry& fixed_registry();

}  // namespace lightloom::toy
