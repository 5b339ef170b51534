#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "framework/graph/plan.hpp"

namespace lightloom {

/// How long what is in a value's memory matters.
enum class Keeping : uint8_t {
  frame,       ///< from its write to its last use in the same frame
  history,     ///< a ring: later frames read it
  persistent,  ///< its pass goes on from what it left
  once,        ///< written in the first frame, for all frames
  constant,    ///< cleared once, for all frames
};
[[nodiscard]] std::string_view to_string(Keeping keeping);  ///< "frame", "history", …

/// The steps of a frame, by index into Plan::steps, in which a value is touched: written, read at any age, observed.
struct Lifetime {
  Keeping keeping = Keeping::frame;
  std::optional<uint32_t> first;  ///< empty: no step touches it
  uint32_t last = 0;              ///< included
};

/// By value.
[[nodiscard]] std::vector<Lifetime> lifetimes(const Plan& plan);

}  // namespace lightloom
