#include "framework/graph/format.hpp"

#include <array>
#include <cstddef>

namespace lightloom {
namespace {

using enum NumericClass;

constexpr std::array<FormatInfo, 12> kFormats{{
    {"r8_unorm", 1, 1, floating, false},
    {"rgba8_unorm", 4, 4, floating, false},
    {"r16_sfloat", 2, 1, floating, false},
    {"rg16_sfloat", 4, 2, floating, false},
    {"rgba16_sfloat", 8, 4, floating, false},
    {"r32_sfloat", 4, 1, floating, false},
    {"rg32_sfloat", 8, 2, floating, false},
    {"rgba32_sfloat", 16, 4, floating, false},
    {"r32_uint", 4, 1, unsigned_integer, false},
    {"rg32_uint", 8, 2, unsigned_integer, false},
    {"rgba32_uint", 16, 4, unsigned_integer, false},
    {"d32_sfloat", 4, 1, floating, true},
}};
static_assert(kFormats.size() == static_cast<std::size_t>(Format::d32_sfloat) + 1);

}  // namespace

const FormatInfo& format_info(Format format) {
  return kFormats.at(static_cast<std::size_t>(format));
}

}  // namespace lightloom
