#include "framework/graph/format.hpp"

#include <array>
#include <cstddef>
#include <limits>

namespace lightloom {
namespace {

using enum NumericClass;
using enum Encoding;

constexpr std::array<FormatInfo, 13> kFormats{{
    {"r8_unorm", 1, 1, floating, false, unorm},
    {"rgba8_unorm", 4, 4, floating, false, unorm},
    {"rgba16_unorm", 8, 4, floating, false, unorm},
    {"r16_sfloat", 2, 1, floating, false, sfloat},
    {"rg16_sfloat", 4, 2, floating, false, sfloat},
    {"rgba16_sfloat", 8, 4, floating, false, sfloat},
    {"r32_sfloat", 4, 1, floating, false, sfloat},
    {"rg32_sfloat", 8, 2, floating, false, sfloat},
    {"rgba32_sfloat", 16, 4, floating, false, sfloat},
    {"r32_uint", 4, 1, unsigned_integer, false, uint},
    {"rg32_uint", 8, 2, unsigned_integer, false, uint},
    {"rgba32_uint", 16, 4, unsigned_integer, false, uint},
    {"d32_sfloat", 4, 1, floating, true, sfloat},
}};
static_assert(kFormats.size() == static_cast<std::size_t>(Format::d32_sfloat) + 1);

constexpr float kLargestHalf = 65504;

std::vector<Format> colour_formats() {
  std::vector<Format> formats;
  for (std::size_t i = 0; i < kFormats.size(); ++i)
    if (!kFormats.at(i).depth) formats.push_back(static_cast<Format>(i));
  return formats;
}

}  // namespace

const FormatInfo& format_info(Format format) {
  return kFormats.at(static_cast<std::size_t>(format));
}

uint32_t channel_bits(Format format) {
  const FormatInfo& info = format_info(format);
  return info.bytes_per_texel * 8 / info.channels;
}

float largest_number(Format format) {
  switch (format_info(format).encoding) {
    case unorm:
      return 1;
    case sfloat:
      return channel_bits(format) == 16 ? kLargestHalf : std::numeric_limits<float>::max();
    case uint:
      break;
  }
  return 4294967295.0f;
}

std::optional<Format> find_format(std::string_view name) {
  for (const Format format : colour_formats())
    if (format_info(format).name == name) return format;
  return std::nullopt;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format format : colour_formats()) names.emplace_back(format_info(format).name);
  return names;
}

std::vector<Format> storage_choices(Format format) {
  const FormatInfo& wanted = format_info(format);
  if (wanted.depth) return {format};
  std::vector<Format> choices;
  for (const Format candidate : colour_formats())
    if (const FormatInfo& info = format_info(candidate);
        info.channels == wanted.channels && info.encoding == wanted.encoding)
      choices.push_back(candidate);
  return choices;
}

}  // namespace lightloom
