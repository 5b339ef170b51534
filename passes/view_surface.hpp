#pragma once

#include "framework/graph/pass_type.hpp"

namespace lightloom::passes {

/// Pictures of the G-buffer for people.
PassType make_view_surface();

}  // namespace lightloom::passes
