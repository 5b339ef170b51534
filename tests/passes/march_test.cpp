#include <gtest/gtest.h>

#include <cmath>

#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

class March : public DeviceTest {};

Port view_output(const std::string& name) {
  Port port = passes::image_output_like(name, Format::rgba32_sfloat, "", "for the host");
  port.extent = ExtentRule::view;
  return port;
}

PassType make_test_march() {
  PassType type;
  type.name = "test_march";
  type.doc = "Marches random rays.";
  type.ports = {passes::volume_input("distance", "distance field"), view_output("origin"), view_output("direction"),
                view_output("hit")};
  type.params = {{"end", ParamType::real, 1e30, 0, 1e30, {}, "voxels", "length of the rays"}};
  type.record = [](PassContext& context) { context.dispatch({"test_march.comp", context.output_extent("hit"), {}}); };
  return type;
}

scene::Scene clutter() {
  const std::vector<QuadSpec> quads = {
      {{-1, -1, 1}, {2, 0, 0}, {0, 0, -2}},
      {{-0.8f, -0.6f, -0.7f}, {1.1f, 0.3f, 0.2f}, {0.1f, 0.9f, 0.4f}},
      {{0.2f, -0.9f, 0.1f}, {0.5f, 0.4f, 0.3f}, {-0.4f, 0.5f, 0.1f}},
      {{0.6f, 0.2f, -0.9f}, {0.02f, 0, 0}, {0, 0.8f, 0.5f}},
      {{-1, 0.95f, -1}, {0.5f, 0, 0}, {0, 0, 0.5f}},
      {{-0.1f, 0.3f, 0.5f}, {0.05f, 0.02f, 0}, {0, 0.03f, 0.06f}},
  };
  return make_quad_scene(quads, {}, look_at({0, 0, 4}, {0, 0, 0}, 0.8f));
}

Images run_march(int radius, double end) {
  const std::string passes = R"("voxelize": { "type": "voxelize", "params": { "resolution": 40 } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" }, "params": { "radius": )" +
                             std::to_string(radius) + R"( } },
    "march": { "type": "test_march", "in": { "distance": "distance.distance" }, "params": { "end": )" +
                             std::to_string(end) + " } }";
  GraphRunOptions options;
  options.extra_types = {make_test_march()};
  options.capture = {"voxelize.voxels.albedo"};
  return run_graph(graph_text(256, 128, 256, 128, passes,
                              R"("origin": "march.origin", "direction": "march.direction", "hit": "march.hit")"),
                   clutter(), options)
      .front();
}

struct Ray {
  float origin[3], direction[3];
};

/// First occupied voxel at t = 0, 1, 2, …; -1 if there is none. No distance field is used.
double unit_steps(const image::HostImage& albedo, const Ray& ray, double end, int voxel[3]) {
  const Extent3 size = albedo.desc.extent;
  const int extent[3] = {static_cast<int>(size.width), static_cast<int>(size.height), static_cast<int>(size.depth)};
  for (int t = 0; t <= 400 && t <= end; ++t) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      voxel[axis] = static_cast<int>(std::floor(ray.origin[axis] + ray.direction[axis] * static_cast<float>(t)));
      inside = inside && voxel[axis] >= 0 && voxel[axis] < extent[axis];
    }
    if (inside && albedo.at(voxel[0], voxel[1], voxel[2], 3) > 0.5) return t;
  }
  return -1;
}

void expect_same_hits(const Images& images, double end) {
  const image::HostImage& albedo = images.at("voxelize.voxels.albedo");
  int hits = 0, misses = 0;
  for (uint32_t y = 0; y < 128; ++y)
    for (uint32_t x = 0; x < 256; ++x) {
      Ray ray{};
      for (uint32_t axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = static_cast<float>(images.at("origin").at(x, y, 0, axis));
        ray.direction[axis] = static_cast<float>(images.at("direction").at(x, y, 0, axis));
      }
      int voxel[3] = {};
      const double t = unit_steps(albedo, ray, end, voxel);
      ASSERT_EQ(images.at("hit").at(x, y, 0, 3), t) << x << " " << y;
      if (t < 0 && ++misses) continue;
      ++hits;
      for (uint32_t axis = 0; axis < 3; ++axis)
        ASSERT_EQ(images.at("hit").at(x, y, 0, axis), voxel[axis]) << x << " " << y;
    }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 3000);
}

TEST_F(March, FindsWhatUnitStepsFind) {
  for (const int radius : {1, 4, 15}) expect_same_hits(run_march(radius, 1e6), 1e6);
}

TEST_F(March, StopsAtTheEnd) {
  expect_same_hits(run_march(4, 9), 9);
}

}  // namespace
}  // namespace lightloom::test
