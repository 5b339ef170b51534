#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "passes/port_rows.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

class March : public DeviceTest {};

constexpr uint32_t kWidth = 256, kHeight = 128;
constexpr double kTie = 1e-3;  ///< voxels; closer than this to an edge, rounding may choose the neighbour

Port view_output(const std::string& name) {
  Port port = passes::image_output_like(name, Format::rgba32_sfloat, "", "for the host");
  port.extent = ExtentRule::view;
  return port;
}

PassType make_test_march() {
  PassType type;
  type.name = "test_march";
  type.doc = "Marches random rays.";
  Port boxes = passes::optional(passes::image_input("boxes", Format::rgba32_uint, "empty boxes"));
  boxes.dimension = Dimension::d3;
  type.ports = {passes::volume_input("distance", "distance field"),
                boxes,
                view_output("origin"),
                view_output("direction"),
                view_output("hit"),
                view_output("face")};
  type.params = {{"end", ParamType::real, 1e30, 0, 1e30, {}, "voxels", "length of the rays"},
                 {"salt", ParamType::integer, int64_t{0}, 0, {}, {}, "", "of the random numbers"},
                 {"march",
                  ParamType::choice,
                  std::string("sphere"),
                  {},
                  {},
                  {"sphere", "cube_exit", "dda", "box_exit"},
                  "",
                  "how"}};
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

const std::string kClutter = R"({ "type": "voxelize", "params": { "resolution": 40 } })";

std::string random_voxels(int resolution, double density) {
  return R"({ "type": "voxel_pattern", "params": { "resolution": )" + std::to_string(resolution) + R"(, "density": )" +
         std::to_string(density) + " } }";
}

Images run_march(const std::string& march, const std::string& voxels, int radius, double end, int salt = 0) {
  const std::string passes = R"("voxels": )" + voxels + R"(,
    "distance": { "type": "distance_transform", "in": { "voxels": "voxels.voxels" }, "params": { "radius": )" +
                             std::to_string(radius) + R"( } },
    "boxes": { "type": "empty_boxes", "in": { "distance": "distance.distance" } },
    "march": { "type": "test_march", "in": { "distance": "distance.distance", "boxes": "boxes.boxes" }, "params": { "march": ")" +
                             march + R"(", "salt": )" + std::to_string(salt) + R"(, "end": )" + std::to_string(end) +
                             " } }";
  GraphRunOptions options;
  options.extra_types = {make_test_march(), make_voxel_pattern()};
  options.capture = {"voxels.voxels.albedo"};
  return run_graph(graph_text(kWidth, kHeight, kWidth, kHeight, passes,
                              R"("origin": "march.origin", "direction": "march.direction", "hit": "march.hit",
                                 "face": "march.face")"),
                   clutter(), options)
      .front();
}

struct Ray {
  float origin[3], direction[3];
};

Ray ray_at(const Images& images, uint32_t x, uint32_t y) {
  Ray ray{};
  for (uint32_t axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = static_cast<float>(images.at("origin").at(x, y, 0, axis));
    ray.direction[axis] = static_cast<float>(images.at("direction").at(x, y, 0, axis));
  }
  return ray;
}

glm::dvec3 xyz(const image::HostImage& image, uint32_t x, uint32_t y) {
  return {image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2)};
}

bool occupied_at(const image::HostImage& albedo, const glm::ivec3& voxel) {
  const Extent3& size = albedo.desc.extent;
  const glm::ivec3 extent(size.width, size.height, size.depth);
  return glm::all(glm::greaterThanEqual(voxel, glm::ivec3(0))) && glm::all(glm::lessThan(voxel, extent)) &&
         occupied(albedo, voxel);
}

/// First occupied voxel at t = 0, 1, 2, …; -1 if there is none. No distance field is used.
double unit_steps(const image::HostImage& albedo, const Ray& ray, double end, glm::ivec3& voxel) {
  for (int t = 0; t <= 1000 && t <= end; ++t) {
    for (int axis = 0; axis < 3; ++axis)
      voxel[axis] = static_cast<int>(std::floor(ray.origin[axis] + ray.direction[axis] * static_cast<float>(t)));
    if (occupied_at(albedo, voxel)) return t;
  }
  return -1;
}

void expect_same_hits(const Images& images, double end) {
  const image::HostImage& albedo = images.at("voxels.voxels.albedo");
  int hits = 0, misses = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      glm::ivec3 voxel(0);
      const double t = unit_steps(albedo, ray_at(images, x, y), end, voxel);
      ASSERT_EQ(images.at("hit").at(x, y, 0, 3), t) << x << " " << y;
      if (t < 0 && ++misses) continue;
      ++hits;
      ASSERT_EQ(xyz(images.at("hit"), x, y), glm::dvec3(voxel)) << x << " " << y;
    }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 3000);
}

TEST_F(March, SphereFindsWhatUnitStepsFind) {
  for (const int radius : {1, 4, 15}) expect_same_hits(run_march("sphere", kClutter, radius, 1e6), 1e6);
  expect_same_hits(run_march("sphere", random_voxels(40, 0.015), 4, 1e6), 1e6);
}

TEST_F(March, SphereStopsAtTheEnd) {
  expect_same_hits(run_march("sphere", kClutter, 4, 9), 9);
}

/// Interval of the ray parameter within a box, in double precision; empty if x > y. `gap`: how far the axis that
/// decides its start is from the next one [voxels].
glm::dvec2 box_interval(const Ray& ray, const glm::dvec3& low, const glm::dvec3& high, int& axis, double& gap) {
  glm::dvec2 interval(-INFINITY, INFINITY);
  glm::dvec3 starts(-INFINITY);
  for (int a = 0; a < 3; ++a) {
    const double o = ray.origin[a], d = ray.direction[a];
    if (d == 0) {
      if (o < low[a] || o >= high[a]) return {1, -1};
      continue;
    }
    starts[a] = std::min((low[a] - o) / d, (high[a] - o) / d);
    interval.y = std::min(interval.y, std::max((low[a] - o) / d, (high[a] - o) / d));
  }
  axis = starts.x >= starts.y && starts.x >= starts.z ? 0 : starts.y >= starts.z ? 1 : 2;
  interval.x = starts[axis];
  gap = INFINITY;
  for (int a = 0; a < 3; ++a)
    if (a != axis) gap = std::min(gap, starts[axis] - starts[a]);
  return interval;
}

struct Crossing {
  glm::ivec3 voxel{0};
  double t = 0;
  int axis = -1;  ///< -1: the ray starts in the voxel
  int steps = 1;  ///< voxels looked at, this one included
};

/// First occupied voxel in double precision: voxel after voxel (Amanatides and Woo 1987) from where the ray enters the
/// grid. `tied`: it passed so near to an edge between voxels that rounding may choose.
std::optional<Crossing> exact_hit(const image::HostImage& albedo, const Ray& ray, double end, bool& tied) {
  const Extent3& size = albedo.desc.extent;
  const glm::ivec3 extent(size.width, size.height, size.depth);
  Crossing at;
  double gap = INFINITY;
  const glm::dvec2 inside = box_interval(ray, glm::dvec3(0), glm::dvec3(extent), at.axis, gap);
  tied = gap < kTie || std::abs(inside.y - inside.x) < kTie || std::abs(inside.y) < kTie || std::abs(inside.x) < kTie;
  if (inside.x > inside.y || inside.y < 0) return std::nullopt;
  at.t = std::max(inside.x, 0.0);
  if (inside.x <= 0) at.axis = -1;
  glm::dvec3 exits(INFINITY);
  for (int a = 0; a < 3; ++a) {
    const double p = ray.origin[a] + ray.direction[a] * at.t;
    at.voxel[a] = static_cast<int>(std::floor(p));
    if (a == at.axis) at.voxel[a] = ray.direction[a] > 0 ? 0 : extent[a] - 1;
    if (a != at.axis && at.t > 0 && std::abs(p - std::round(p)) < kTie) tied = true;
  }
  while (at.t <= end) {
    if (!occupied_at(albedo, at.voxel) && glm::any(glm::greaterThanEqual(at.voxel, extent))) return std::nullopt;
    if (glm::any(glm::lessThan(at.voxel, glm::ivec3(0)))) return std::nullopt;
    if (occupied_at(albedo, at.voxel)) return at;
    for (int a = 0; a < 3; ++a)
      exits[a] = ray.direction[a] == 0
                     ? INFINITY
                     : (at.voxel[a] + (ray.direction[a] > 0 ? 1.0 : 0.0) - ray.origin[a]) / ray.direction[a];
    at.axis = exits.x <= exits.y && exits.x <= exits.z ? 0 : exits.y <= exits.z ? 1 : 2;
    at.t = exits[at.axis];
    for (int a = 0; a < 3; ++a)
      if (a != at.axis && (exits[a] - at.t) * std::abs(ray.direction[a]) < kTie) tied = true;
    at.voxel[at.axis] += ray.direction[at.axis] > 0 ? 1 : -1;
    ++at.steps;
  }
  tied = tied || at.t - end < kTie;
  return std::nullopt;
}

/// `least_hits`: least number of them that the rays must have.
void expect_exact(const Images& images, double end, int least_hits = 2000) {
  const image::HostImage& albedo = images.at("voxels.voxels.albedo");
  int hits = 0, misses = 0, ties = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const Ray ray = ray_at(images, x, y);
      const double t = images.at("hit").at(x, y, 0, 3);
      const glm::dvec3 voxel = xyz(images.at("hit"), x, y);
      bool tied = false;
      const std::optional<Crossing> expected = exact_hit(albedo, ray, end, tied);
      if (t >= 0) {
        // Whatever the tie, what is reported is occupied, and the ray touches it.
        ASSERT_TRUE(occupied_at(albedo, glm::ivec3(voxel))) << x << " " << y;
        int axis = 0;
        double gap = 0;
        const glm::dvec2 touch = box_interval(ray, voxel - kTie, voxel + 1.0 + kTie, axis, gap);
        ASSERT_LE(touch.x, touch.y) << x << " " << y;
        ASSERT_LE(t, end);
      }
      if (tied && ++ties) continue;
      ASSERT_EQ(expected.has_value(), t >= 0) << x << " " << y;
      if (!expected && ++misses) continue;
      ++hits;
      ASSERT_EQ(voxel, glm::dvec3(expected->voxel)) << x << " " << y;
      ASSERT_NEAR(t, expected->t, 1e-5 * (1 + std::abs(expected->t)) + 1e-3) << x << " " << y;
      if (expected->axis < 0) continue;
      glm::dvec3 face(0);
      face[expected->axis] = ray.direction[expected->axis] > 0 ? -1 : 1;
      ASSERT_EQ(xyz(images.at("face"), x, y), face) << x << " " << y;
      ASSERT_NEAR(images.at("direction").at(x, y, 0, 3), expected->t, 2e-3) << x << " " << y;
    }
  EXPECT_GT(hits, least_hits);
  EXPECT_GT(misses, 3000);
  EXPECT_LT(ties, static_cast<int>(kWidth * kHeight) / 3);
}

class ExactMarch : public March, public testing::WithParamInterface<const char*> {};

TEST_P(ExactMarch, FindsEveryVoxelThatARayTouches) {
  for (const int radius : {1, 4, 15}) {
    expect_exact(run_march(GetParam(), kClutter, radius, 1e6, radius), 1e6);
    expect_exact(run_march(GetParam(), random_voxels(40, 0.012), radius, 1e6, radius), 1e6);
  }
  expect_exact(run_march(GetParam(), random_voxels(64, 0.006), 4, 1e6), 1e6);
}

TEST_P(ExactMarch, StopsAtTheEnd) {
  expect_exact(run_march(GetParam(), kClutter, 4, 9.25), 9.25, 1000);
}

TEST_P(ExactMarch, EmptyAndFullGridsEnd) {
  const Images empty = run_march(GetParam(), random_voxels(16, 0), 4, 1e6);
  const Images full = run_march(GetParam(), random_voxels(16, 1), 4, 1e6);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      ASSERT_EQ(empty.at("hit").at(x, y, 0, 3), -1);
      bool tied = false;
      const bool hits = exact_hit(full.at("voxels.voxels.albedo"), ray_at(full, x, y), 1e6, tied).has_value();
      if (tied) continue;
      ASSERT_EQ(full.at("hit").at(x, y, 0, 3) >= 0, hits) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, ExactMarch, testing::Values("cube_exit", "dda", "box_exit"),
                         [](const testing::TestParamInfo<const char*>& mode) { return std::string(mode.param); });

/// Distances read by the ray of a texel.
double steps_at(const Images& images, uint32_t x, uint32_t y) {
  return images.at("face").at(x, y, 0, 3);
}

double total_steps(const Images& images) {
  double sum = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) sum += steps_at(images, x, y);
  return sum;
}

TEST_F(March, CountsTheVoxelsThatItLooksAt) {
  const Images dda = run_march("dda", kClutter, 4, 1e6);
  int compared = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      bool tied = false;
      const std::optional<Crossing> expected = exact_hit(dda.at("voxels.voxels.albedo"), ray_at(dda, x, y), 1e6, tied);
      if (tied || !expected) continue;
      ASSERT_EQ(steps_at(dda, x, y), expected->steps) << x << " " << y;
      ++compared;
    }
  EXPECT_GT(compared, 2000);
  EXPECT_LE(total_steps(run_march("cube_exit", kClutter, 1, 1e6)), total_steps(dda));
  EXPECT_LT(total_steps(run_march("cube_exit", kClutter, 15, 1e6)), 0.5 * total_steps(dda));
  EXPECT_LT(total_steps(run_march("box_exit", kClutter, 4, 1e6)),
            0.6 * total_steps(run_march("cube_exit", kClutter, 15, 1e6)));
}

TEST_F(March, SphereEntersThroughTheFaceThatTheRayMeets) {
  const Images images = run_march("sphere", kClutter, 4, 1e6);
  int compared = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (images.at("hit").at(x, y, 0, 3) < 0) continue;
      const Ray ray = ray_at(images, x, y);
      const glm::dvec3 voxel = xyz(images.at("hit"), x, y);
      int axis = 0;
      double gap = 0;
      const glm::dvec2 inside = box_interval(ray, voxel, voxel + 1.0, axis, gap);
      if (gap < kTie || inside.x > inside.y) continue;
      glm::dvec3 face(0);
      face[axis] = ray.direction[axis] > 0 ? -1 : 1;
      ASSERT_EQ(xyz(images.at("face"), x, y), face) << x << " " << y;
      ASSERT_NEAR(images.at("direction").at(x, y, 0, 3), inside.x, 2e-3) << x << " " << y;
      ++compared;
    }
  EXPECT_GT(compared, 2000);
}

}  // namespace
}  // namespace lightloom::test
