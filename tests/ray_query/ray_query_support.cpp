#include "tests/ray_query/ray_query_support.hpp"

#include <algorithm>

namespace lightloom::test {

void RayQueryTest::SetUp() {
  const std::vector<gpu::DeviceSummary> devices = gpu::list_devices();
  const bool any = std::any_of(devices.begin(), devices.end(), [](const gpu::DeviceSummary& summary) {
    return summary.usable && summary.info.ray_query.available;
  });
  if (!any) GTEST_SKIP() << "no device with ray queries";
  if (!device().info().ray_query.available)
    GTEST_SKIP() << "no device with ray queries: '" << device().info().name << "' was chosen, another has them";
  DeviceTest::SetUp();
}

void RayQueryTest::TearDown() {
  if (!IsSkipped()) DeviceTest::TearDown();
}

std::vector<Images> trace_rays(const scene::Scene& scene, const RaySettings& settings) {
  std::string passes = R"("gather": { "type": "gather" })";
  std::string outputs = R"("position": "gather.surface.position", "radiance": "trace0.radiance")";
  for (size_t i = 0; i < settings.bounces.size(); ++i) {
    const std::string index = std::to_string(i);
    passes += ", \"trace" + index + R"(": { "type": ")" + settings.type +
              R"(", "in": { "surface": "gather.surface" }, "params": { "bounces": )" +
              std::to_string(settings.bounces[i]) + (settings.params.empty() ? "" : ", ") + settings.params + " } }";
    outputs += ", \"radiance" + index + R"(": "trace)" + index + ".radiance\"";
  }
  GraphRunOptions options;
  options.frames = settings.frames;
  options.seed = settings.seed;
  const uint32_t size = settings.size;
  return run_graph(graph_text(size, size, size, size, passes, outputs), scene, options);
}

scene::Material lamp_material(const glm::vec3& radiance, bool two_sided) {
  scene::Material material = lambertian(glm::vec3(0));
  material.emission = radiance;
  material.double_sided = two_sided;
  return material;
}

}  // namespace lightloom::test
