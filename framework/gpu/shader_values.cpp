#include "framework/gpu/shader_values.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <variant>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace lightloom::gpu {
namespace {

/// Every value that a ShaderValue holds is exact in double.
double number_of(const ShaderValue& value) {
  return std::visit([](auto v) { return static_cast<double>(v); }, value.value);
}

template <class T>
bool holds(double number) {
  if constexpr (std::is_same_v<T, float>) {
    return std::isnan(number) || static_cast<double>(static_cast<float>(number)) == number;
  } else {
    return number >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
           number <= static_cast<double>(std::numeric_limits<T>::max()) && std::trunc(number) == number;
  }
}

[[noreturn]] void fail_conversion(const ShaderValue& value, ScalarType type, std::string_view shader) {
  throw Error(ExitCode::invalid_input, "shader " + std::string(shader) + ": the value " +
                                           std::to_string(number_of(value)) + " of " + in_quotes(value.name) +
                                           " cannot be a " + std::string(to_string(type)));
}

const ShaderValue* find_value(std::span<const ShaderValue> values, std::string_view name) {
  for (const ShaderValue& value : values) {
    if (value.name == name) return &value;
  }
  return nullptr;
}

}  // namespace

uint32_t encode_value(const ShaderValue& value, ScalarType type, std::string_view shader) {
  const double number = number_of(value);
  switch (type) {
    case ScalarType::boolean:
      if (number == 0 || number == 1) return number != 0 ? VK_TRUE : VK_FALSE;
      break;
    case ScalarType::int32:
      if (holds<int32_t>(number)) return std::bit_cast<uint32_t>(static_cast<int32_t>(number));
      break;
    case ScalarType::uint32:
      if (holds<uint32_t>(number)) return static_cast<uint32_t>(number);
      break;
    case ScalarType::float32:
      if (holds<float>(number)) return std::bit_cast<uint32_t>(static_cast<float>(number));
      break;
    case ScalarType::other:
      break;
  }
  fail_conversion(value, type, shader);
}

std::vector<std::byte> encode_push_constants(const Reflection& reflection, std::span<const ShaderValue> values) {
  std::vector<std::byte> bytes(reflection.push_constant_size);
  for (const BlockMember& member : reflection.push_constants) {
    const std::string place = "shader " + reflection.name + ": push constant " + in_quotes(member.name);
    if (member.components != 1 || member.columns != 1 || member.array || member.type == ScalarType::other) {
      throw Error(ExitCode::invalid_input, place + " is no single bool, int, uint or float");
    }
    const ShaderValue* value = find_value(values, member.name);
    if (value == nullptr) throw Error(ExitCode::invalid_input, place + " has no value");
    const uint32_t bits = encode_value(*value, member.type, reflection.name);
    std::memcpy(bytes.data() + member.offset, &bits, sizeof(bits));
  }
  return bytes;
}

}  // namespace lightloom::gpu
