#pragma once

#include <string>
#include <string_view>

#include "framework/base/limits.hpp"

namespace lightloom::scene {

/// Throws Error where the JSON text of a glTF file is larger, deeper or holds more than `limits` allow. Reads the text
/// once without allocating, before a parser makes values of it that take many times its size; grammar is the parser's
/// business.
void require_json_within(std::string_view text, const Limits& limits, const std::string& file);

}  // namespace lightloom::scene
