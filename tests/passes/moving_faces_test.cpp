#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/passes/moving_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

using MovingFacesTest = DeviceTest;
constexpr int kFrames = 10;

scene::Material glowing(const glm::vec3& radiance, bool double_sided) {
  scene::Material material = plain(glm::vec3(0.5f));
  material.emission = radiance;
  material.double_sided = double_sided;
  return material;
}

std::vector<Placement> placements(const std::function<Placement(int)>& at) {
  std::vector<Placement> result;
  for (int frame = 0; frame < kFrames; ++frame) result.push_back(at(frame));
  return result;
}

/// A room of 6 x 3 x 4 m with a panel that emits; lamps and dark things that move in it, two before the panel.
scene::Scene room_of_lamps() {
  scene::Scene room = make_triangle_scene(
      {{glm::vec3(0, 0, 0), glm::vec3(0, 0, 4), glm::vec3(6, 0, 4)},
       {glm::vec3(0, 0, 0), glm::vec3(6, 0, 4), glm::vec3(6, 0, 0)},
       {glm::vec3(1, 2.8f, 1), glm::vec3(5, 2.8f, 1), glm::vec3(1, 2.8f, 3)},
       {glm::vec3(0, 3, 0), glm::vec3(0, 0, 0), glm::vec3(6, 0, 1)}},
      {plain(glm::vec3(0.25f)), plain(glm::vec3(0.25f)), glowing({4, 3, 2}, false), plain(glm::vec3(0.25f))});
  const auto cube = [](float half_edge) { return cube_triangles(half_edge, glm::mat3(1)); };
  const auto turn = [](int frame) {
    return glm::angleAxis(0.4f * static_cast<float>(frame), glm::vec3(0.6f, 0, 0.8f));
  };
  return with_moving(
      std::move(room),
      {{cube(0.3f), glowing({1, 8, 1}, true), placements([&](int f) {  // turns, and rests from frame 6 on
          return Placement{{1.2f, 0.8f, 1.0f}, turn(std::min(f, 6)), 1};
        })},
       {cube(0.2f), glowing({9, 1, 1}, false), placements([&](int f) {  // appears and vanishes
          return Placement{{4.5f, 1.5f, 1.0f}, turn(1), f < 2 || f > 4 ? 0.0f : 1.0f};
        })},
       {cube(0.2f), glowing({1, 1, 5}, false), placements([&](int f) {  // outside the grid every third frame
          return Placement{
              {f % 3 == 2 && f < 8 ? 20.0f : 5.0f, 0.4f + 2.0f * static_cast<float>(f < 8 ? f % 2 : 0), 3}, turn(2), 1};
        })},
       {cube(0.3f), plain({0, 0, 1}), placements([&](int f) {  // through the panel
          return Placement{{2.0f + 0.2f * static_cast<float>(std::min(f, 5)), 2.7f, 1.6f}, turn(2), 1};
        })},
       {cube(0.2f), plain({0, 1, 1}), placements([&](int f) {  // along the floor, where nothing emits, for ever
          return Placement{{1.0f + 0.3f * static_cast<float>(f), 0.0f, 3.5f}, turn(f), 1};
        })}});
}

void expect_same(const Images& images, const std::string& got, const std::string& expected) {
  EXPECT_TRUE(images.at(got).texels == images.at(expected).texels) << got << " is not " << expected;
}

std::vector<Images> list_faces_of(const scene::Scene& scene) {
  GraphRunOptions options;
  options.frames = kFrames;
  options.capture = {"*"};
  return run_graph(R"({ "lightloom": 1, "name": "test", "view": { "width": 16, "height": 16 },
      "trace": { "width": 16, "height": 16 }, "passes": {
      "s": { "type": "voxelize", "params": { "resolution": 48, "geometry": "static", "priority": "emissive" } },
      "d": { "type": "voxelize", "params": { "resolution": 48, "geometry": "dynamic", "priority": "emissive" } },
      "m": { "type": "voxel_merge", "in": { "static": "s.voxels", "dynamic": "d.voxels" } },
      "f": { "type": "emissive_faces", "in": { "voxels": "m.voxels" } },
      "fresh": { "type": "emissive_faces", "in": { "voxels": "m.voxels" }, "params": { "update": "all" } },
      "late": { "type": "emissive_faces", "in": { "voxels": "d.voxels@1" } },
      "late_fresh": { "type": "emissive_faces", "in": { "voxels": "d.voxels@1" }, "params": { "update": "all" } }
      }, "outputs": { "output": "f.faces" } })",
                   scene, options);
}

TEST_F(MovingFacesTest, WhatMovedAloneGivesTheSameListAsAllAfresh) {
  const std::vector<Images> frames = list_faces_of(room_of_lamps());
  std::vector<double> counts;
  for (size_t frame = 0; frame < frames.size(); ++frame) {
    SCOPED_TRACE(frame);
    expect_same(frames[frame], "f.faces", "fresh.faces");
    expect_same(frames[frame], "f.power", "fresh.power");
    expect_same(frames[frame], "late.faces", "late_fresh.faces");
    expect_same(frames[frame], "late.power", "late_fresh.power");
    counts.push_back(frames[frame].at("f.faces").at(0, 0, 0, 0));
  }
  // The list grows and shrinks, and stays as it is in the end while something still moves.
  EXPECT_GT(counts.front(), 500);
  EXPECT_GT(std::set<double>(counts.begin(), counts.end()).size(), 5u);
  EXPECT_FALSE(std::is_sorted(counts.begin(), counts.end()));
  EXPECT_FALSE(std::is_sorted(counts.rbegin(), counts.rend()));
  EXPECT_TRUE(frames[9].at("f.faces").texels == frames[8].at("f.faces").texels);
  EXPECT_FALSE(frames[9].at("m.voxels.albedo").texels == frames[8].at("m.voxels.albedo").texels);
}

}  // namespace
}  // namespace lightloom::test
