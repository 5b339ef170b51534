#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lightloom {

/// 64-bit FNV-1a (Fowler, Noll, Vo; RFC 9923). Not for adversaries: names, cache keys, equality of results.
class Hasher {
 public:
  void bytes(const void* data, std::size_t size);
  /// Length first, so that "ab","c" and "a","bc" differ.
  void text(std::string_view value);
  /// Little endian whatever the machine.
  void number(uint64_t value);
  /// By bit pattern.
  void real(double value);
  [[nodiscard]] uint64_t value() const { return state_; }

 private:
  uint64_t state_ = 14695981039346656037ULL;
};

[[nodiscard]] uint64_t hash_bytes(const void* data, std::size_t size);
[[nodiscard]] uint64_t hash_text(std::string_view text);  ///< of the characters alone, without a length
/// 16 lower-case hexadecimal digits.
[[nodiscard]] std::string hex(uint64_t value);

}  // namespace lightloom
