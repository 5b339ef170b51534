#pragma once

#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"
#include "framework/image/host_image.hpp"
#include "framework/scene/scene.hpp"
#include "tests/support/graph_runner.hpp"

namespace lightloom::test {

/// A test pass: `surface` in, `radiance` out with a known pattern (param `pattern`: constant, noise, impulse, normal,
/// object, ramp, frame, spoilt, bump, step, texture) times the param `scale`, as large as `surface`.
PassType make_pattern();

/// Graph text around `passes` (the inner text of "passes"); `outputs` likewise.
std::string graph_text(uint32_t view_width, uint32_t view_height, uint32_t trace_width, uint32_t trace_height,
                       const std::string& passes, const std::string& outputs);

/// White Lambertian, without any specular reflection.
scene::Material lambertian(const glm::vec3& base_color);

/// Mean of a channel over the pixels with alpha above 0 in [x0, x1) x [y0, y1).
double mean_of(const image::HostImage& image, uint32_t channel, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1);

/// The chain voxelize, distance, gather (all of one size), trace; `extra` are the trace's params, `inputs` more of its
/// inputs (with a comma ahead), both as JSON members.
std::string trace_passes(int resolution, const std::string& extra, const std::string& inputs = "");

}  // namespace lightloom::test
