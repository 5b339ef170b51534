#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "framework/gpu/reflection.hpp"
#include "framework/graph/pass_context.hpp"

namespace lightloom::gpu {

/// The 32 bits of a value as a shader constant of type `type`. Conversions that keep the value are made (true to 1u, 3
/// to 3.0f); others throw Error(invalid_input) that names the shader and the value.
[[nodiscard]] uint32_t encode_value(const ShaderValue& value, ScalarType type, std::string_view shader);

/// The bytes of the push constant block. Every member must be a scalar with a value of its name, else
/// Error(invalid_input).
[[nodiscard]] std::vector<std::byte> encode_push_constants(const Reflection& reflection,
                                                           std::span<const ShaderValue> values);

}  // namespace lightloom::gpu
