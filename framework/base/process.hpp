#pragma once

#include <cstdint>

namespace lightloom {

/// The most memory that this process has held at one time [bytes]; 0 where the system does not tell.
[[nodiscard]] uint64_t peak_memory_bytes();
/// What it holds now [bytes]; 0 where the system does not tell.
[[nodiscard]] uint64_t memory_bytes();

}  // namespace lightloom
