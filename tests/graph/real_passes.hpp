#pragma once

#include "framework/graph/pass_type.hpp"
#include "passes/registry.hpp"

namespace lightloom {

/// The pass types that ship, for the graphs that ship.
inline const PassRegistry& real_passes() {
  static const PassRegistry types = [] {
    PassRegistry result;
    passes::register_builtin_passes(result);
    return result;
  }();
  return types;
}

}  // namespace lightloom
