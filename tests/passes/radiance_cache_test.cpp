#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/passes/light_scenes.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/passes/moving_support.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kSize = 24;

class RadianceCache : public DeviceTest {};

/// A room whose walls emit 2 W sr^-1 m^-2 and reflect `albedo`, seen from its middle; its walls are boundaries of
/// voxels of a grid of 34.
scene::Scene emissive_room(double albedo) {
  scene::Material wall = lambertian(glm::vec3(static_cast<float>(albedo)));
  wall.emission = glm::vec3(2);
  wall.double_sided = true;
  return make_quad_scene(room_walls(glm::vec3(-1), glm::vec3(1), 0), {wall},
                         look_at({0, 0, 0}, {0.3f, -0.2f, 1}, 1.2f));
}

/// A cache with those params and what it needs; inputs besides are `inputs`, with a comma ahead.
std::string cache_passes(int resolution, const std::string& params, const std::string& inputs) {
  return R"("voxelize": { "type": "voxelize", "params": { "resolution": )" + std::to_string(resolution) + R"( } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
    "cache": { "type": "radiance_cache", "in": { "voxels": "voxelize.voxels", "distance": "distance.distance",
               "faces": "faces.faces")" +
         inputs + R"( }, "params": { "nee": "voxel_faces")" + params + " } }";
}

const std::string kWithPast = R"(, "cache": "cache.light@1")";

/// The cache's light in each frame.
std::vector<Images> cached_frames(const scene::Scene& scene, const std::string& passes, uint32_t frames) {
  GraphRunOptions options;
  options.frames = frames;
  return run_graph(
      graph_text(kSize, kSize, kSize, kSize, passes, R"("light": "cache.light", "albedo": "voxelize.voxels.albedo")"),
      scene, options);
}

struct CacheMean {
  double light = 0;
  double samples = 0;
  int voxels = 0;
};

/// Over the voxels of which something is known.
CacheMean mean_of_known(const image::HostImage& light) {
  CacheMean mean;
  for_each_voxel(light, [&](const glm::ivec3& voxel) {
    const auto value = [&](uint32_t channel) {
      return light.at(static_cast<uint32_t>(voxel.x), static_cast<uint32_t>(voxel.y), static_cast<uint32_t>(voxel.z),
                      channel);
    };
    if (value(3) == 0) return;
    mean.light += value(1);
    mean.samples += value(3);
    ++mean.voxels;
  });
  mean.light /= mean.voxels;
  mean.samples /= mean.voxels;
  return mean;
}

/// The series of all bounces: radiance L = emission + albedo L comes from everywhere. In the first frame by whole
/// paths, then by what was known before.
TEST_F(RadianceCache, HoldsTheWholeSeriesOfAnEmissiveRoomFromTheFirstFrameOn) {
  for (const double root : {180.0 / 255, 228.0 / 255}) {
    const double expected = 2 / (1 - root * root);
    const std::vector<Images> frames =
        cached_frames(emissive_room(root * root), cache_passes(34, R"(, "bounces": 64)", kWithPast), 12);
    for (size_t frame = 0; frame < frames.size(); ++frame)
      EXPECT_NEAR(mean_of_known(frames[frame].at("light")).light, expected, 0.01 * expected) << root << " " << frame;
  }
}

TEST_F(RadianceCache, WithoutAPastEachFrameStandsAlone) {
  const std::vector<Images> frames = cached_frames(emissive_room(0.5), cache_passes(34, R"(, "bounces": 0)", ""), 3);
  // Scattered once at the cache's own voxel: only what the walls emit comes there.
  for (const Images& frame : frames) {
    EXPECT_NEAR(mean_of_known(frame.at("light")).light, 2, 0.02);
    EXPECT_EQ(mean_of_known(frame.at("light")).samples, 1);
  }
}

TEST_F(RadianceCache, KnowsEachOccupiedVoxelAndNoOther) {
  const std::vector<Images> frames = cached_frames(emissive_room(0.5), cache_passes(34, "", kWithPast), 3);
  const Images& last = frames.back();
  for_each_voxel(last.at("light"), [&](const glm::ivec3& voxel) {
    const auto samples = last.at("light").at(static_cast<uint32_t>(voxel.x), static_cast<uint32_t>(voxel.y),
                                             static_cast<uint32_t>(voxel.z), 3);
    ASSERT_EQ(samples, occupied(last.at("albedo"), voxel) ? 3 : 0) << voxel.x << " " << voxel.y << " " << voxel.z;
  });
}

TEST_F(RadianceCache, SamplesOneOfAnIntervalInTurnAndForgetsGradually) {
  const std::vector<Images> frames =
      cached_frames(emissive_room(0.5), cache_passes(34, R"(, "interval": 4, "frames": 3)", kWithPast), 14);
  // At once, then every fourth frame: four frames on each voxel has one sample more, until the mean holds three.
  EXPECT_EQ(mean_of_known(frames[0].at("light")).samples, 1);
  EXPECT_NEAR(mean_of_known(frames[1].at("light")).samples, 1.25, 0.02);
  EXPECT_EQ(mean_of_known(frames[4].at("light")).samples, 2);
  EXPECT_EQ(mean_of_known(frames[13].at("light")).samples, 3);
}

std::string tracer(const std::string& params) {
  return R"(, "gather": { "type": "gather" },
    "trace": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
               "distance": "distance.distance", "faces": "faces.faces", "cache": "cache.light" },
               "params": { "nee": "voxel_faces", )" +
         params + " } }";
}

/// Mean of the tracer's radiance in the last of some frames.
double traced(const scene::Scene& scene, const std::string& passes, uint32_t frames = 1) {
  GraphRunOptions options;
  options.frames = frames;
  const Images images =
      run_graph(graph_text(kSize, kSize, kSize, kSize, passes, R"("radiance": "trace.radiance")"), scene, options)
          .back();
  return mean_of(images.at("radiance"), 1, 0, 0, kSize, kSize);
}

TEST_F(RadianceCache, PathsThatEndByItHaveTheLightOfAllBounces) {
  const double albedo = 228.0 * 228 / (255 * 255);
  const double expected = 2 / (1 - albedo);
  const std::string cache = cache_passes(34, R"(, "bounces": 64)", kWithPast);
  for (const std::string from : {"1", "2"})
    EXPECT_NEAR(traced(emissive_room(albedo), cache + tracer(R"("paths": 16, "bounces": 2, "cache_from": )" + from), 4),
                expected, 0.01 * expected)
        << from;
  // Without it they end at the third scattering.
  EXPECT_NEAR(traced(emissive_room(albedo), cache + tracer(R"("paths": 16, "bounces": 2)")),
              2 * (1 - std::pow(albedo, 3)) / (1 - albedo), 0.01 * expected);
}

/// Light that a wall without thickness lets through, beside what comes where there is none: voxels know one normal, and
/// where walls meet it may be that of the lit side.
TEST_F(RadianceCache, LetsLittleThroughAWall) {
  const std::string passes =
      cache_passes(40, R"(, "bounces": 64)", kWithPast) + tracer(R"("paths": 16, "bounces": 4, "cache_from": 1)");
  for (const glm::mat3& turn : {turned(0, 0), turned(0.4f, 0), turned(0.5f, 0.3f)})
    EXPECT_LT(traced(two_rooms(turn, true), passes, 4), 0.01 * traced(two_rooms(turn, false), passes, 4));
}

/// A box that moves a voxel's length a frame: what it leaves is empty, what it comes to is known at once.
TEST_F(RadianceCache, FollowsWhatMoves) {
  const scene::Scene room = make_quad_scene(room_walls(glm::vec3(-1), glm::vec3(1), 0), {lambertian(glm::vec3(0.5f))},
                                            look_at({0, 0, 0}, {0.3f, -0.2f, 1}, 1.2f));
  std::vector<Placement> placements;
  for (int frame = 0; frame < 4; ++frame)
    placements.push_back({glm::vec3(-0.3f + 0.15f * static_cast<float>(frame), 0, 0)});
  const scene::Scene scene =
      with_moving(room, {{cube_triangles(0.2f, glm::mat3(1)), lambertian(glm::vec3(0.5f)), placements}});
  const std::vector<Images> frames = cached_frames(scene, cache_passes(34, R"(, "interval": 16)", kWithPast), 4);
  for (const Images& frame : frames)
    for_each_voxel(frame.at("light"), [&](const glm::ivec3& voxel) {
      const bool known = frame.at("light").at(static_cast<uint32_t>(voxel.x), static_cast<uint32_t>(voxel.y),
                                              static_cast<uint32_t>(voxel.z), 3) > 0;
      ASSERT_EQ(known, occupied(frame.at("albedo"), voxel)) << voxel.x << " " << voxel.y << " " << voxel.z;
    });
}

}  // namespace
}  // namespace lightloom::test
