#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace lightloom::reference {

/// What a pair of numbers decides at one vertex of a path.
enum class Decision : uint32_t {
  emitter,        ///< which emissive triangle
  emitter_point,  ///< where on it
  sun,
  punctual,  ///< which punctual light
  environment_cell,
  environment_point,
  lobe,
  direction,
  pixel,  ///< where within the pixel the path starts
};

/// The random numbers of one path: a function of pixel, frame, seed, path, vertex and decision, so that they are the
/// same whichever thread asks, in whichever order. Counters under the finalizer of SplitMix64 (Steele, Lea and Flood,
/// "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014).
class PathRandom {
 public:
  PathRandom(uint32_t x, uint32_t y, uint32_t frame, uint32_t seed, uint32_t path) {
    const uint64_t pixel = mix((uint64_t{y} << 32 | x) + kGolden);
    const uint64_t run = mix(pixel ^ (uint64_t{seed} << 32 | frame));
    key_ = mix(run + kGolden * (uint64_t{path} + 1));
  }

  /// Two independent uniform numbers in [0, 1 - 2^-24]; `vertex` counts from 0 at the first hit.
  [[nodiscard]] glm::vec2 pair(uint32_t vertex, Decision decision) const {
    const uint64_t counter = uint64_t{vertex} * 16 + static_cast<uint32_t>(decision) + 1;
    const uint64_t bits = mix(key_ + kGolden * counter);
    return {static_cast<float>(bits >> 40) * 0x1p-24f, static_cast<float>(bits >> 8 & 0xFFFFFFu) * 0x1p-24f};
  }

 private:
  static constexpr uint64_t kGolden = 0x9E3779B97F4A7C15u;

  static uint64_t mix(uint64_t z) {
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
  }

  uint64_t key_ = 0;
};

}  // namespace lightloom::reference
