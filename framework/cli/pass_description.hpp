#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "framework/graph/pass_type.hpp"

namespace lightloom::cli {

/// One line a type: name and the first sentence of its doc.
[[nodiscard]] std::string list_passes(const PassRegistry& registry);
/// Doc, ports and params of one type as text of 100 columns.
[[nodiscard]] std::string describe_pass(const PassType& type);
/// All types as a Markdown page; docs/passes.md is its output.
[[nodiscard]] std::string passes_markdown(const PassRegistry& registry);
[[nodiscard]] nlohmann::ordered_json pass_json(const PassType& type);

/// "any extent", "view size", "like `radiance`", …
[[nodiscard]] std::string extent_text(const Port& port);
/// "1 to 16 frames", "tangent | bitangent", …; empty where every value is allowed.
[[nodiscard]] std::string allowed_text(const Param& param);

}  // namespace lightloom::cli
