#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_temporal_accumulate();

/// The same with what earlier frames saw packed by `pack_surface`.
[[nodiscard]] PassType make_temporal_accumulate_packed();

}  // namespace lightloom::passes
