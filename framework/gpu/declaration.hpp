#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lightloom::gpu {

/// The line, counted from 1, in which GLSL text declares a name of its interface: a uniform, buffer or constant, or a
/// member of a block of them; empty if it does not. Conditions and macros are not looked at.
[[nodiscard]] std::optional<uint32_t> declaration_line(std::string_view text, std::string_view name);

}  // namespace lightloom::gpu
