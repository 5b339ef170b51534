#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <string_view>

namespace lightloom::gpu {

/// What memory of a device is for.
enum class MemoryPurpose : uint8_t {
  images,   ///< one image each
  buffers,  ///< one buffer each, acceleration structures among them
  shared,   ///< by images that are not live at the same time
  staging,  ///< the host writes or reads: uploads, read-backs
};
constexpr size_t kMemoryPurposes = 4;
[[nodiscard]] std::string_view to_string(MemoryPurpose purpose);

/// Bytes by purpose.
struct MemoryBytes {
  std::array<uint64_t, kMemoryPurposes> of{};
  [[nodiscard]] uint64_t operator[](MemoryPurpose purpose) const { return of.at(static_cast<size_t>(purpose)); }
  [[nodiscard]] uint64_t total() const;
};

/// Counts the memory that is allocated from a device. From any thread.
class MemoryLedger {
 public:
  void add(MemoryPurpose purpose, uint64_t bytes);
  void remove(MemoryPurpose purpose, uint64_t bytes);
  [[nodiscard]] MemoryBytes now() const;
  /// The most of each purpose so far, not all at the same time.
  [[nodiscard]] MemoryBytes peaks() const;
  /// The most of all together so far.
  [[nodiscard]] uint64_t peak() const;

 private:
  mutable std::mutex mutex_;
  MemoryBytes now_;
  MemoryBytes peaks_;
  uint64_t peak_ = 0;
};

}  // namespace lightloom::gpu
