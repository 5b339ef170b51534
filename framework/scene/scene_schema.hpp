#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lightloom::scene {

/// JSON Schema (2020-12) of scene files, with what read_scene_file accepts: keys, types, ranges and defaults.
[[nodiscard]] nlohmann::ordered_json scene_schema();

}  // namespace lightloom::scene
