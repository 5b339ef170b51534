#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Adds every pass type that ships with Lightloom.
void register_builtin_passes(PassRegistry& registry);

}  // namespace lightloom::passes
