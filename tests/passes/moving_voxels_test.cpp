#include <gtest/gtest.h>

#include <filesystem>

#include "tests/passes/moving_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

using MovingVoxelsTest = DeviceTest;
constexpr int kFrames = 9;
constexpr int kRadius = 3;
constexpr std::array<const char*, 3> kParts = {".voxels.albedo", ".voxels.normal", ".voxels.material"};

std::vector<Placement> placements(const std::function<Placement(int)>& at) {
  std::vector<Placement> result;
  for (int frame = 0; frame < kFrames; ++frame) result.push_back(at(frame));
  return result;
}

/// A room of 6 x 3 x 4 m with a floor, a slanted wall and things that move in every way there is.
scene::Scene moving_scene() {
  scene::Scene room = make_triangle_scene({{glm::vec3(0, 0, 0), glm::vec3(0, 0, 4), glm::vec3(6, 0, 4)},
                                           {glm::vec3(0, 0, 0), glm::vec3(6, 0, 4), glm::vec3(6, 0, 0)},
                                           {glm::vec3(0, 3, 0), glm::vec3(0, 0, 0), glm::vec3(6, 0, 1)}},
                                          {plain(glm::vec3(0.25f))});
  const glm::vec3 axis = glm::normalize(glm::vec3(1, 2, 3));
  const auto cube = [](float half_edge) { return cube_triangles(half_edge, glm::mat3(1)); };
  const auto turn = [&](int frame) { return glm::angleAxis(0.4f * static_cast<float>(frame), axis); };
  return with_moving(
      std::move(room),
      {{cube(0.4f), plain({1, 0, 0}), placements([&](int f) {
          return Placement{{1.2f, 0.3f, 1.0f}, turn(f), 1};
        })},
       {cube(0.3f), plain({0, 1, 0}), placements([&](int f) {  // along the floor, over the next one, and out
          return Placement{{1.5f + 0.9f * static_cast<float>(f), 0.2f, 2.5f}, turn(1), 1};
        })},
       {cube(0.3f), plain({0, 0, 1}), placements([&](int f) {  // at rest until it moves on once
          return Placement{{3.3f, f < 6 ? 0.3f : 1.9f, 2.5f}, turn(2), 1};
        })},
       {cube(0.5f), plain({1, 1, 0}), placements([&](int f) {  // appears and vanishes
          return Placement{{4.5f, 1.5f, 1.0f}, turn(3), f == 0 || f == 1 || f >= 5 ? 0.0f : 1.0f};
        })},
       {cube(0.2f), plain({0, 1, 1}), placements([&](int f) {  // jumps; outside the grid every third frame
          return Placement{{f % 3 == 2 ? 20.0f : 5.0f, 0.4f + 2.0f * static_cast<float>(f % 2), 3.4f}, turn(f), 1};
        })}});
}

/// A graph of 16 x 16 pixels with the given passes; all values of all frames.
std::vector<Images> run_voxel_graph(const std::string& passes, const std::string& output, const scene::Scene& scene) {
  GraphRunOptions options;
  options.frames = kFrames;
  options.capture = {"*"};
  return run_graph(R"({ "lightloom": 1, "name": "test", "view": { "width": 16, "height": 16 },
           "trace": { "width": 16, "height": 16 }, "passes": { )" +
                       passes + R"( }, "outputs": { "output": ")" + output + "\" } }",
                   scene, options);
}

/// The chain as the graphs have it, and beside it the same without its memory, and everything voxelized at once.
std::vector<Images> run_chains(const std::string& coverage, const std::string& priority) {
  const auto voxelize = [&](const std::string& name, const std::string& geometry, const std::string& update) {
    return "\"" + name + R"(": { "type": "voxelize", "params": { "resolution": 40, "geometry": ")" + geometry +
           R"(", "coverage": ")" + coverage + R"(", "update": ")" + update + "\" } },\n";
  };
  const auto rest = [&](const std::string& suffix, const std::string& update) {
    return "\"m" + suffix + R"(": { "type": "voxel_merge", "in": { "static": "s.voxels", "dynamic": "d)" + suffix +
           R"(.voxels" }, "params": { "priority": ")" + priority + R"(", "update": ")" + update + "\" } },\n\"t" +
           suffix + R"(": { "type": "distance_transform", "in": { "voxels": "m)" + suffix +
           R"(.voxels" }, "params": { "radius": )" + std::to_string(kRadius) + R"(, "update": ")" + update + "\" } }";
  };
  return run_voxel_graph(voxelize("s", "static", "moved") + voxelize("d", "dynamic", "moved") +
                             voxelize("d_fresh", "dynamic", "all") + voxelize("a", "all", "moved") +
                             voxelize("a_fresh", "all", "all") + rest("", "moved") + ",\n" + rest("_fresh", "all"),
                         "t.distance", moving_scene());
}

void expect_same(const Images& images, const std::string& got, const std::string& expected) {
  EXPECT_TRUE(images.at(got).texels == images.at(expected).texels) << got << " is not " << expected;
}

void expect_same_voxels(const Images& images, const std::string& got, const std::string& expected) {
  for (const char* part : kParts) expect_same(images, got + part, expected + part);
}

size_t count_occupied(const image::HostImage& albedo) {
  size_t count = 0;
  for_each_voxel(albedo, [&](const glm::ivec3& voxel) { count += occupied(albedo, voxel) ? 1 : 0; });
  return count;
}

TEST_F(MovingVoxelsTest, WhatMovedAloneGivesTheSameBitsAsEverythingAfresh) {
  for (const char* coverage : {"supercover", "raster"}) {
    const std::vector<Images> frames = run_chains(coverage, "dynamic");
    std::vector<size_t> counts;
    for (size_t frame = 0; frame < frames.size(); ++frame) {
      SCOPED_TRACE(std::string(coverage) + ", frame " + std::to_string(frame));
      const Images& images = frames[frame];
      expect_same_voxels(images, "d", "d_fresh");
      expect_same(images, "d.owner", "d_fresh.owner");
      expect_same_voxels(images, "a", "a_fresh");
      // Dynamic triangles come last in draw order, so that one grid of all triangles is the merged one.
      expect_same_voxels(images, "m", "a_fresh");
      expect_same(images, "t.distance", "t_fresh.distance");
      counts.push_back(count_occupied(images.at("d.voxels.albedo")));
    }
    // The scene does what it is made for: things come, go and change places.
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), *std::min_element(counts.begin(), counts.end()) + 100);
  }
}

TEST_F(MovingVoxelsTest, StaticOnTopIsTheSameToo) {
  for (const Images& images : run_chains("supercover", "static")) {
    expect_same_voxels(images, "m", "m_fresh");
    const image::HostImage& fixed = images.at("s.voxels.albedo");
    for_each_voxel(fixed, [&](const glm::ivec3& voxel) {
      if (!occupied(fixed, voxel)) return;
      ASSERT_EQ(byte_at(images.at("m.voxels.albedo"), voxel, 0), byte_at(fixed, voxel, 0));
    });
  }
}

TEST_F(MovingVoxelsTest, DistancesOfEveryFrameAreThoseOfBruteForce) {
  for (const Images& images : run_chains("supercover", "dynamic")) {
    const image::HostImage& albedo = images.at("m.voxels.albedo");
    const image::HostImage& distance = images.at("t.distance");
    std::vector<glm::ivec3> solid;
    for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
      if (occupied(albedo, voxel)) solid.push_back(voxel);
    });
    const Extent3& extent = albedo.desc.extent;
    const auto index = [&](const glm::ivec3& v) {
      return static_cast<size_t>((v.z * static_cast<int>(extent.height) + v.y) * static_cast<int>(extent.width) + v.x);
    };
    // Every occupied voxel tells all within the radius.
    std::vector<int> expected(size_t{extent.width} * extent.height * extent.depth, kRadius + 1);
    for (const glm::ivec3& from : solid)
      for (int z = std::max(from.z - kRadius, 0); z <= std::min<int>(from.z + kRadius, extent.depth - 1); ++z)
        for (int y = std::max(from.y - kRadius, 0); y <= std::min<int>(from.y + kRadius, extent.height - 1); ++y)
          for (int x = std::max(from.x - kRadius, 0); x <= std::min<int>(from.x + kRadius, extent.width - 1); ++x) {
            int& least = expected[index({x, y, z})];
            least = std::min(least, std::max({std::abs(x - from.x), std::abs(y - from.y), std::abs(z - from.z)}));
          }
    for_each_voxel(distance, [&](const glm::ivec3& voxel) {
      ASSERT_EQ(byte_at(distance, voxel, 0), expected[index(voxel)]) << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
    });
  }
}

TEST_F(MovingVoxelsTest, VoxelsOfTheFrameBeforeAreFollowedToo) {
  const std::string passes = R"(
      "s": { "type": "voxelize", "params": { "resolution": 40, "geometry": "static" } },
      "d": { "type": "voxelize", "params": { "resolution": 40, "geometry": "dynamic" } },
      "m": { "type": "voxel_merge", "in": { "static": "s.voxels", "dynamic": "d.voxels@1" } },
      "t": { "type": "distance_transform", "in": { "voxels": "m.voxels" } },
      "m_fresh": { "type": "voxel_merge", "in": { "static": "s.voxels", "dynamic": "d.voxels@1" },
                   "params": { "update": "all" } },
      "t_fresh": { "type": "distance_transform", "in": { "voxels": "m_fresh.voxels" }, "params": { "update": "all" } })";
  const std::vector<Images> frames = run_voxel_graph(passes, "t.distance", moving_scene());
  for (size_t frame = 0; frame < frames.size(); ++frame) {
    SCOPED_TRACE(frame);
    expect_same_voxels(frames[frame], "m", "m_fresh");
    expect_same(frames[frame], "t.distance", "t_fresh.distance");
  }
}

/// Skinned, morphed and rigid objects of glTF files.
TEST_F(MovingVoxelsTest, SkinsMorphsAndNodesLeaveNoTrail) {
  const std::filesystem::path folder = source_dir() / "../shared/scenes/khronos";
  for (const char* file :
       {"Fox/glTF/Fox.gltf", "AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", "BoxAnimated/glTF/BoxAnimated.gltf"}) {
    SCOPED_TRACE(file);
    if (!std::filesystem::exists(folder / file)) GTEST_SKIP() << "there is no " << folder / file;
    const scene::Scene scene = scene::load_scene(folder / file);
    const std::string passes = R"(
        "s": { "type": "voxelize", "params": { "resolution": 48, "geometry": "static" } },
        "d": { "type": "voxelize", "params": { "resolution": 48, "geometry": "dynamic" } },
        "m": { "type": "voxel_merge", "in": { "static": "s.voxels", "dynamic": "d.voxels" } },
        "a_fresh": { "type": "voxelize", "params": { "resolution": 48, "update": "all" } },
        "t": { "type": "distance_transform", "in": { "voxels": "m.voxels" } },
        "t_fresh": { "type": "distance_transform", "in": { "voxels": "a_fresh.voxels" }, "params": { "update": "all" } })";
    const std::vector<Images> frames = run_voxel_graph(passes, "t.distance", scene);
    EXPECT_GT(count_occupied(frames.front().at("d.voxels.albedo")), 100u);
    EXPECT_FALSE(frames.front().at("d.voxels.albedo").texels == frames.back().at("d.voxels.albedo").texels);
    for (const Images& images : frames) {
      expect_same_voxels(images, "m", "a_fresh");
      expect_same(images, "t.distance", "t_fresh.distance");
    }
  }
}

TEST_F(MovingVoxelsTest, WhatIsScaledToNothingOrLeavesTheGridIsGone) {
  const std::vector<Images> frames = run_chains("supercover", "dynamic");
  const auto count_color = [&](size_t frame, const glm::ivec3& color) {
    const image::HostImage& albedo = frames[frame].at("m.voxels.albedo");
    size_t count = 0;
    for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
      const bool same = byte_at(albedo, voxel, 0) == color.r && byte_at(albedo, voxel, 1) == color.g &&
                        byte_at(albedo, voxel, 2) == color.b;
      count += same && occupied(albedo, voxel) ? 1 : 0;
    });
    return count;
  };
  const glm::ivec3 yellow(255, 255, 0);
  const glm::ivec3 green(0, 255, 0);
  const glm::ivec3 cyan(0, 255, 255);
  for (const size_t gone : {0, 1, 5, 8}) EXPECT_EQ(count_color(gone, yellow), 0u) << gone;
  for (const size_t there : {2, 4}) EXPECT_GT(count_color(there, yellow), 100u) << there;
  EXPECT_GT(count_color(1, green), 30u);
  EXPECT_EQ(count_color(8, green), 0u);
  for (size_t frame = 0; frame < frames.size(); ++frame)
    EXPECT_EQ(count_color(frame, cyan) > 0, frame % 3 != 2) << frame;
}

}  // namespace
}  // namespace lightloom::test
