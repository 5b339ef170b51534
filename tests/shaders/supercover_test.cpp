#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"
#include "tests/support/voxel_oracle.hpp"

namespace lightloom::test {
namespace {

using SupercoverTest = DeviceTest;

constexpr int kSide = 20;
constexpr size_t kVoxels = kSide * kSide * kSide;
constexpr double kBorder = 1e-4;  // voxels: nearer to touching than this, either answer is right

/// One invocation a triangle; counts how often the column loop visits each voxel.
const std::string kCover = R"(
#include "lib/supercover.glsl"
vec3 input_vector(uint at) { return vec3(inputs[at], inputs[at + 1], inputs[at + 2]); }
void evaluate(uint index) {
  const int side = 20;
  Corners t = Corners(input_vector(9 * index), input_vector(9 * index + 3), input_vector(9 * index + 6));
  Supercover cover = make_supercover(t, ivec3(side));
  for (uint i = 0; i < column_count(cover); ++i) {
    ivec2 where = column(cover, i);
    if (!column_touched(cover, where)) continue;
    ivec2 span = column_span(cover, where);
    for (int z = span.x; z <= span.y; ++z) {
      if (!voxel_touched(cover, ivec3(where, z))) continue;
      ivec3 v = turn_back(ivec3(where, z), cover.axis);
      outputs[index * side * side * side + (v.z * side + v.y) * side + v.x] += 1.0;
    }
  }
})";

std::vector<float> covers(gpu::Device& device, const std::vector<GridTriangle>& triangles) {
  std::vector<float> inputs;
  for (const GridTriangle& t : triangles)
    for (const glm::dvec3& corner : t)
      inputs.insert(inputs.end(),
                    {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(corner.z)});
  return run_snippet(device, kCover, inputs, triangles.size() * kVoxels, static_cast<uint32_t>(triangles.size()));
}

glm::ivec3 voxel_at(size_t index) {
  return {static_cast<int>(index) % kSide, static_cast<int>(index) / kSide % kSide,
          static_cast<int>(index) / (kSide * kSide)};
}

/// How far a plane may be off: a cross product is rounded relative to its edges' lengths.
double plane_error(const GridTriangle& t) {
  const double length = std::max(glm::distance(t[0], t[1]), glm::distance(t[0], t[2]));
  const glm::dvec3 normal = glm::abs(glm::cross(t[1] - t[0], t[2] - t[0]));
  return 1e-6 * length * length * length / std::max({normal.x, normal.y, normal.z});
}

/// Compares with the oracle; `exact` false leaves out "too many", for triangles so narrow that their plane is unknown.
void expect_supercover(const std::vector<GridTriangle>& triangles, const std::vector<float>& got, bool exact) {
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (size_t i = 0; i < kVoxels; ++i) {
      const float visits = got[t * kVoxels + i];
      ASSERT_LE(visits, 1.0f) << "a voxel is visited twice";
      if (visits == 0.0f) {
        ASSERT_FALSE(touches_voxel(triangles[t], voxel_at(i), -kBorder)) << "triangle " << t << " misses voxel " << i;
      } else if (exact) {
        ASSERT_TRUE(touches_voxel(triangles[t], voxel_at(i), kBorder + plane_error(triangles[t])))
            << "triangle " << t << " has voxel " << i;
      }
    }
  }
}

std::vector<GridTriangle> random_triangles(size_t count, double size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-3, kSide + 3);
  std::uniform_real_distribution<double> around(-size, size);
  std::vector<GridTriangle> result(count);
  for (GridTriangle& t : result) {
    const glm::dvec3 center(anywhere(random), anywhere(random), anywhere(random));
    for (glm::dvec3& corner : t)
      corner = glm::dvec3(glm::vec3(center + glm::dvec3(around(random), around(random), around(random))));
  }
  return result;
}

TEST_F(SupercoverTest, EqualsSeparatingAxesForTrianglesOfAllSizes) {
  for (const double size : {0.02, 0.7, 4.0, 30.0}) {
    SCOPED_TRACE("size " + std::to_string(size));
    const std::vector<GridTriangle> triangles = random_triangles(150, size);
    expect_supercover(triangles, covers(device(), triangles), true);
  }
}

TEST_F(SupercoverTest, AnAxisAlignedQuadInsideALayerFillsThatLayerOnly) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto corner = [axis](double u, double v) {
      glm::dvec3 p(0);
      p[axis] = 7.5;
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v;
      return p;
    };
    const std::vector<GridTriangle> quad = {{corner(2.5, 3.5), corner(11.5, 3.5), corner(11.5, 8.5)},
                                            {corner(2.5, 3.5), corner(11.5, 8.5), corner(2.5, 8.5)}};
    const std::vector<float> got = covers(device(), quad);
    for (size_t i = 0; i < kVoxels; ++i) {
      const glm::ivec3 v = voxel_at(i);
      const int u = v[(axis + 1) % 3];
      const int w = v[(axis + 2) % 3];
      const bool expected = v[axis] == 7 && u >= 2 && u <= 11 && w >= 3 && w <= 8;
      ASSERT_EQ(got[i] + got[kVoxels + i] > 0, expected) << "axis " << axis << " voxel " << i;
    }
  }
}

TEST_F(SupercoverTest, APlaneOnTheBorderOfTwoLayersTouchesBoth) {
  const std::vector<GridTriangle> triangle = {{glm::dvec3(2, 9, 2), glm::dvec3(2, 9, 18), glm::dvec3(18, 9, 2)}};
  const std::vector<float> got = covers(device(), triangle);
  for (const int y : {8, 9}) EXPECT_EQ(got[static_cast<size_t>((5 * kSide + y) * kSide + 5)], 1.0f);
  for (const int y : {7, 10}) EXPECT_EQ(got[static_cast<size_t>((5 * kSide + y) * kSide + 5)], 0.0f);
}

TEST_F(SupercoverTest, NarrowTrianglesHaveNoGaps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inside(0.5, kSide - 0.5);
  std::uniform_real_distribution<double> tiny(-1, 1);
  std::vector<GridTriangle> slivers;
  for (const double width : {1e-1, 1e-3, 1e-5, 0.0}) {
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 a(inside(random), inside(random), inside(random));
      const glm::dvec3 b(inside(random), inside(random), inside(random));
      const glm::dvec3 c = glm::mix(a, b, 0.3) + width * glm::dvec3(tiny(random), tiny(random), tiny(random));
      slivers.push_back({glm::dvec3(glm::vec3(a)), glm::dvec3(glm::vec3(b)), glm::dvec3(glm::vec3(c))});
    }
  }
  expect_supercover(slivers, covers(device(), slivers), false);
}

TEST_F(SupercoverTest, NearestPointIsTheNearest) {
  const std::string body = R"(
#include "lib/corners.glsl"
vec3 input_vector(uint at) { return vec3(inputs[at], inputs[at + 1], inputs[at + 2]); }
void evaluate(uint index) {
  Corners t = Corners(input_vector(12 * index), input_vector(12 * index + 3), input_vector(12 * index + 6));
  vec3 w = nearest_barycentric(input_vector(12 * index + 9), t);
  for (uint i = 0; i < 3; ++i) outputs[3 * index + i] = w[i];
})";
  std::vector<GridTriangle> triangles = random_triangles(4000, 2.0);
  triangles.push_back({glm::dvec3(1), glm::dvec3(1), glm::dvec3(1)});
  triangles.push_back({glm::dvec3(1), glm::dvec3(2), glm::dvec3(3)});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> around(-4, 4);
  std::vector<float> inputs;
  std::vector<glm::dvec3> points;
  for (const GridTriangle& t : triangles) {
    points.emplace_back(glm::vec3(t[0] + glm::dvec3(around(random), around(random), around(random))));
    for (const glm::dvec3& p : {t[0], t[1], t[2], points.back()})
      for (int axis = 0; axis < 3; ++axis) inputs.push_back(static_cast<float>(p[axis]));
  }
  const std::vector<float> got =
      run_snippet(device(), body, inputs, triangles.size() * 3, static_cast<uint32_t>(triangles.size()));
  for (size_t i = 0; i < triangles.size(); ++i) {
    const glm::dvec3 w(got[3 * i], got[3 * i + 1], got[3 * i + 2]);
    EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-5);
    EXPECT_GE(std::min({w.x, w.y, w.z}), -1e-5);
    const GridTriangle& t = triangles[i];
    const double expected = glm::distance(points[i], nearest_on_triangle(points[i], t));
    EXPECT_NEAR(glm::distance(points[i], t[0] * w.x + t[1] * w.y + t[2] * w.z), expected, 1e-3) << "triangle " << i;
  }
}

}  // namespace
}  // namespace lightloom::test
