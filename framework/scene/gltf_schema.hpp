#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lightloom::scene {

/// Checks the JSON of a glTF file before anything reads it: types, required members, ranges, and that each index points
/// into its array. Throws Error naming `file` and the member ("meshes[0].primitives[1].indices").
/// Members that the loader does not use are not looked at.
void check_gltf_json(const nlohmann::json& document, const std::string& file);

/// Throws Error if `text` nests arrays and objects deeper than a sane file does; readers of JSON values recurse.
void check_json_depth(const std::string& text, const std::string& file);

}  // namespace lightloom::scene
