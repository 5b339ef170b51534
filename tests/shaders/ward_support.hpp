#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/pass_context.hpp"
#include "tests/shaders/ward_oracle.hpp"

// shaders/lib/ward.glsl on the device, for the tests of its values, its albedo and its samples.
namespace lightloom::test {

enum class WardForm : uint32_t { ward_1992, dur, bounded };  ///< values of the constant `ward`
enum class WardSampling : uint32_t { exact, phi_uniform };   ///< values of the constant `ward_sampling`

[[nodiscard]] std::vector<ShaderValue> ward_constants(WardForm form, WardSampling sampling);

struct Lobe {
  Direction incoming;
  double ax, ay;
};

/// x, y, z as floats.
void append(std::vector<float>& values, const Direction& direction);

/// Directions and what the lobe gives for them.
struct WardPair {
  Direction i, o;
  double ax, ay;
};
struct WardValues {
  float value;    ///< f(i, o)
  float swapped;  ///< f(o, i)
  float pdf;
  float weight;
};
[[nodiscard]] std::vector<WardValues> evaluate_ward(gpu::Device& device, const std::vector<WardPair>& pairs,
                                                    WardForm form, WardSampling sampling = WardSampling::exact);

struct WardSample {
  float x, y, z;  ///< lost where z <= 0
  float weight;
  float pdf;
};
/// One sample for each pair in `u` (u0, v0, u1, v1, …).
[[nodiscard]] std::vector<WardSample> sample_ward(gpu::Device& device, const Lobe& lobe, const std::vector<float>& u,
                                                  WardForm form, WardSampling sampling);

}  // namespace lightloom::test
