#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/passes/light_scenes.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {

/// Base of tests that trace triangles on the device. Skipped where no device has ray queries.
class RayQueryTest : public DeviceTest {
 protected:
  void SetUp() override;
  void TearDown() override;
};

/// How a test traces: a square image that `type` fills, one pass for each number of bounces.
struct RaySettings {
  std::string params;  ///< of the pass, as JSON members
  std::vector<int> bounces = {3};
  std::string type = "ray_query_path_trace";
  uint32_t size = 32;
  uint32_t frames = 1;
  uint32_t seed = 1;
};

/// Frames of "radiance0", "radiance1", … (one for each entry of `bounces`, divided by the modulation colour; "radiance"
/// is the first) and "position".
std::vector<Images> trace_rays(const scene::Scene& scene, const RaySettings& settings);

/// Emits `radiance` from its front, or from both sides.
scene::Material lamp_material(const glm::vec3& radiance, bool two_sided = false);

}  // namespace lightloom::test
