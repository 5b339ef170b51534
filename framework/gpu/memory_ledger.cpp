#include "framework/gpu/memory_ledger.hpp"

#include <algorithm>
#include <numeric>

namespace lightloom::gpu {

std::string_view to_string(MemoryPurpose purpose) {
  switch (purpose) {
    case MemoryPurpose::images:
      return "images";
    case MemoryPurpose::buffers:
      return "buffers";
    case MemoryPurpose::shared:
      return "shared";
    case MemoryPurpose::staging:
      break;
  }
  return "staging";
}

uint64_t MemoryBytes::total() const {
  return std::accumulate(of.begin(), of.end(), uint64_t{0});
}

void MemoryLedger::add(MemoryPurpose purpose, uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  const auto index = static_cast<size_t>(purpose);
  now_.of.at(index) += bytes;
  peaks_.of.at(index) = std::max(peaks_.of.at(index), now_.of.at(index));
  peak_ = std::max(peak_, now_.total());
}

void MemoryLedger::remove(MemoryPurpose purpose, uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  now_.of.at(static_cast<size_t>(purpose)) -= bytes;
}

MemoryBytes MemoryLedger::now() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

MemoryBytes MemoryLedger::peaks() const {
  const std::lock_guard lock(mutex_);
  return peaks_;
}

uint64_t MemoryLedger::peak() const {
  const std::lock_guard lock(mutex_);
  return peak_;
}

}  // namespace lightloom::gpu
