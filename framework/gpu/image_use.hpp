#pragma once

#include <cstdint>
#include <map>
#include <span>

namespace lightloom::gpu {

/// What the code of a module does with an image, in whatever branch; asking for its size is neither.
struct ImageUse {
  bool read = false;     ///< fetched, sampled, loaded, or changed by an atomic
  bool written = false;  ///< stored to, or changed by an atomic
};

/// By the id of the image's variable; an image that no instruction touches is left out. `words` are valid SPIR-V.
[[nodiscard]] std::map<uint32_t, ImageUse> image_uses(std::span<const uint32_t> words);

}  // namespace lightloom::gpu
