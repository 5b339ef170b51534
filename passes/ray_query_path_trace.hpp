#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

[[nodiscard]] PassType make_ray_query_path_trace();

}  // namespace lightloom::passes
