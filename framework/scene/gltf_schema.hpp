#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/base/limits.hpp"

namespace lightloom::scene {

/// Checks the JSON of a glTF file before anything reads it: types, required members, ranges, and that each index points
/// into its array. Throws Error naming `file` and the member ("meshes[0].primitives[1].indices").
/// Members that the loader does not use are not looked at.
void check_gltf_json(const nlohmann::json& document, const Limits& limits, const std::string& file);

/// Integers may be written with a fraction of zero ("2.0"), which readers that look at the type of a number ignore:
/// turns those into integers. Within extensions, integers beyond 32 bits become reals, as tinygltf would cut them.
void normalise_numbers(nlohmann::json& document, bool in_extension = false);

}  // namespace lightloom::scene
