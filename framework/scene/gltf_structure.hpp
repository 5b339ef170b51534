#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lightloom::scene {

/// Checks what the buffer views and accessors of a glTF file say about bytes: that every one of them, used or not, lies
/// within what it is cut from, is aligned as glTF 2.0 (3.6.2.4) asks, and has a stride that makes sense. To be called
/// on a document that check_gltf_json has passed, before anything is read. Throws Error naming the element.
void check_gltf_structure(const nlohmann::json& document, const std::string& file);

}  // namespace lightloom::scene
