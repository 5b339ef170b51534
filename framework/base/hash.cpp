#include "framework/base/hash.hpp"

#include <bit>

namespace lightloom {

void Hasher::bytes(const void* data, std::size_t size) {
  constexpr uint64_t kPrime = 1099511628211ULL;
  const auto* byte = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ byte[i]) * kPrime;
}

void Hasher::text(std::string_view value) {
  number(value.size());
  bytes(value.data(), value.size());
}

void Hasher::number(uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) {
    const auto byte = static_cast<unsigned char>(value >> shift);
    bytes(&byte, 1);
  }
}

void Hasher::real(double value) {
  number(std::bit_cast<uint64_t>(value));
}

uint64_t hash_bytes(const void* data, std::size_t size) {
  Hasher hasher;
  hasher.bytes(data, size);
  return hasher.value();
}

uint64_t hash_text(std::string_view text) {
  return hash_bytes(text.data(), text.size());
}

std::string hex(uint64_t value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result(16, '0');
  for (std::size_t i = 0; i < 16; ++i) result[15 - i] = kDigits[(value >> (4 * i)) & 15U];
  return result;
}

}  // namespace lightloom
