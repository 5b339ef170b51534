#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "framework/graph/graph.hpp"

namespace lightloom::run {

/// What a scan found in this frame's layer of a value. Texels are numbered x fastest, then y, then z.
struct ScannedValue {
  ValueId value = 0;
  uint32_t nan_texels = 0;            ///< with a NaN in at least one channel
  uint32_t infinite_texels = 0;       ///< with an infinity in at least one channel
  std::optional<uint32_t> first_bad;  ///< first texel with either
  std::array<uint32_t, 4> texel{};    ///< its raw channels
  uint32_t poison_texels = 0;         ///< that hold the poison in all channels; not among the above
  std::optional<uint32_t> first_poison;
  std::array<uint32_t, 2> digest{};  ///< of all texels; zeros in a run without poison
};

}  // namespace lightloom::run
