#include "framework/gpu/buffer_pieces.hpp"

#include <algorithm>
#include <bit>

namespace lightloom::gpu {

BufferPieces pieces_of(uint64_t elements, uint64_t element_bytes, uint64_t most_bytes) {
  // A piece begins at a multiple of 256 bytes, as devices ask at the most, whatever an element has.
  constexpr int kLeastBits = 8;
  constexpr int kMostBits = 31;
  const int bits = std::clamp(static_cast<int>(std::bit_width(most_bytes / element_bytes)) - 1, kLeastBits, kMostBits);
  const uint64_t count = (elements + (uint64_t{1} << bits) - 1) >> bits;
  return {static_cast<uint32_t>(bits), static_cast<uint32_t>(std::max<uint64_t>(count, 1))};
}

Resource resource(const Buffer& buffer, const BufferPieces& pieces, uint64_t element_bytes, uint32_t length) {
  const VkDeviceSize piece_bytes = element_bytes << pieces.bits;
  std::vector<BufferResource> blocks;
  for (uint32_t i = 0; i < length; ++i) {
    const VkDeviceSize offset = i < pieces.count ? i * piece_bytes : 0;
    blocks.push_back({buffer.get(), offset, std::min(piece_bytes, buffer.size() - offset)});
  }
  return blocks;
}

}  // namespace lightloom::gpu
