#pragma once

#include <cstdint>
#include <vector>

#include "framework/gpu/descriptors.hpp"

namespace lightloom::gpu {

/// How a buffer of equal elements is bound: in pieces of 2^bits elements, the last one shorter.
struct BufferPieces {
  uint32_t bits = 31;
  uint32_t count = 1;
};

/// Pieces of at most `most_bytes` (at least 256 elements), as few as can be, at least one.
[[nodiscard]] BufferPieces pieces_of(uint64_t elements, uint64_t element_bytes, uint64_t most_bytes);

/// The pieces of `buffer` for an array of `length` blocks in a shader, at least `pieces.count`; the blocks that are
/// left are given the first piece.
[[nodiscard]] Resource resource(const Buffer& buffer, const BufferPieces& pieces, uint64_t element_bytes,
                                uint32_t length);

}  // namespace lightloom::gpu
