#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/pass_context.hpp"

namespace lightloom::test {

/// Runs a GLSL body in a compute shader and returns its outputs. The body may `#include "lib/…"` (from shaders/) and
/// defines `void evaluate(uint index)`, called once for each index in [0, invocations); it reads `inputs[]` and writes
/// `outputs[]` (both float; outputs start as 0). `constants`: specialization constants by name.
[[nodiscard]] std::vector<float> run_snippet(gpu::Device& device, const std::string& body_glsl,
                                             std::span<const float> inputs, size_t output_count, uint32_t invocations,
                                             std::span<const ShaderValue> constants = {});

}  // namespace lightloom::test
