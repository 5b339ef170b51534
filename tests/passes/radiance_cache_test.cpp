#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
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
/// voxels of a grid of 18.
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

double samples_of(const image::HostImage& light, const glm::ivec3& voxel) {
  return light.at(static_cast<uint32_t>(voxel.x), static_cast<uint32_t>(voxel.y), static_cast<uint32_t>(voxel.z), 3);
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
        cached_frames(emissive_room(root * root), cache_passes(18, R"(, "bounces": 64)", kWithPast), 12);
    for (size_t frame = 0; frame < frames.size(); ++frame)
      EXPECT_NEAR(mean_of_known(frames[frame].at("light")).light, expected, 0.01 * expected) << root << " " << frame;
  }
}

TEST_F(RadianceCache, WithoutAPastEachFrameStandsAlone) {
  const std::vector<Images> frames = cached_frames(emissive_room(0.5), cache_passes(18, R"(, "bounces": 0)", ""), 3);
  // Scattered once at the cache's own voxel: only what the walls emit comes there.
  for (const Images& frame : frames) {
    EXPECT_NEAR(mean_of_known(frame.at("light")).light, 2, 0.05);
    EXPECT_EQ(mean_of_known(frame.at("light")).samples, 1);
  }
}

/// A wall on a boundary of voxels has 16 x 16 of them on each side. Those two from an edge and less are buried: rays
/// from there would start among the voxels of the next wall.
TEST_F(RadianceCache, KnowsTheOpenVoxelsAndNoEmptyOne) {
  const Images last = cached_frames(emissive_room(0.5), cache_passes(18, "", kWithPast), 3).back();
  int known = 0;
  for_each_voxel(last.at("light"), [&](const glm::ivec3& voxel) {
    const double samples = samples_of(last.at("light"), voxel);
    if (!occupied(last.at("albedo"), voxel)) {
      ASSERT_EQ(samples, 0) << voxel.x << " " << voxel.y << " " << voxel.z;
    }
    if (samples == 0) return;
    ASSERT_EQ(samples, 3) << voxel.x << " " << voxel.y << " " << voxel.z;
    ++known;
  });
  EXPECT_EQ(known, 2 * 6 * 14 * 14);
}

TEST_F(RadianceCache, SamplesOneOfAnIntervalInTurnAndForgetsGradually) {
  const std::vector<Images> frames =
      cached_frames(emissive_room(0.5), cache_passes(18, R"(, "interval": 4, "frames": 3)", kWithPast), 14);
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
  const std::string cache = cache_passes(18, R"(, "bounces": 64)", kWithPast);
  for (const std::string from : {"1", "2"})
    EXPECT_NEAR(
        traced(emissive_room(albedo), cache + tracer(R"("paths": 16, "bounces": 16, "cache_from": )" + from), 4),
        expected, 0.01 * expected)
        << from;
  // Paths that may not end by it stop where their bounces do.
  EXPECT_NEAR(traced(emissive_room(albedo), cache + tracer(R"("paths": 16, "bounces": 2)")),
              2 * (1 - std::pow(albedo, 3)) / (1 - albedo), 0.01 * expected);
}

/// Of a wall without thickness the cache knows one side, and that may be the lit one. What leaks where its normal
/// points to the lamp are pixels at its foot, whose rays start within its voxels: of paths that do not end by the
/// cache, too.
TEST_F(RadianceCache, LetsNoMoreThroughAWallThanPathsDo) {
  const std::string cache = cache_passes(24, R"(, "bounces": 8)", kWithPast);
  const std::string to_the_end = cache + tracer(R"("paths": 8, "bounces": 8)");
  const std::string ended = cache + tracer(R"("paths": 8, "bounces": 8, "cache_from": 1)");
  for (const glm::mat3& turn : {turned(0, 0), turned(0.5f, 0.3f)}) {
    EXPECT_EQ(traced(two_rooms(turn, Partition::faces_away), ended, 2), 0);
    const scene::Scene faces_lamp = two_rooms(turn, Partition::faces_lamp);
    EXPECT_LT(traced(faces_lamp, ended, 2), 1.5 * traced(faces_lamp, to_the_end, 2));
  }
  EXPECT_GT(traced(two_rooms(turned(0.5f, 0.3f), Partition::none), ended), 100) << "without a wall between them";
}

/// The cache of a frame ago, of which there is none yet.
TEST_F(RadianceCache, PathsGoOnWhereItKnowsNothing) {
  const std::string passes = cache_passes(18, "", kWithPast);
  std::string ended = tracer(R"("paths": 2, "bounces": 3, "cache_from": 1)");
  ended.replace(ended.find("cache.light"), 11, "cache.light@1");
  EXPECT_EQ(traced(emissive_room(0.5), passes + ended),
            traced(emissive_room(0.5), passes + tracer(R"("paths": 2, "bounces": 3)")));
}

/// Where bounces are few, a cache that has a past makes up for it: once more in each frame.
TEST_F(RadianceCache, ScattersOnceMoreInEachFrame) {
  const std::vector<Images> frames =
      cached_frames(emissive_room(0.5), cache_passes(18, R"(, "bounces": 1)", kWithPast), 12);
  EXPECT_NEAR(mean_of_known(frames.front().at("light")).light, 3, 0.03);
  EXPECT_GT(mean_of_known(frames.back().at("light")).light, 3.3);
  EXPECT_LT(mean_of_known(frames.back().at("light")).light, 4.04);
}

/// A box that moves two voxels a frame: what it leaves is empty, what it comes to is known at once.
TEST_F(RadianceCache, FollowsWhatMoves) {
  std::vector<Placement> placements;
  for (int frame = 0; frame < 3; ++frame)
    placements.push_back({glm::vec3(-0.25f + 0.25f * static_cast<float>(frame), 0, 0)});
  scene::Scene scene = emissive_room(0.5);
  const scene::Material material = scene.materials.front();
  scene = with_moving(std::move(scene), {{cube_triangles(0.625f, glm::mat3(1)), material, placements}});
  for (const Images& frame : cached_frames(scene, cache_passes(18, R"(, "interval": 16)", kWithPast), 3)) {
    int known = 0;
    for_each_voxel(frame.at("light"), [&](const glm::ivec3& voxel) {
      if (samples_of(frame.at("light"), voxel) == 0) return;
      ASSERT_TRUE(occupied(frame.at("albedo"), voxel)) << voxel.x << " " << voxel.y << " " << voxel.z;
      ++known;
    });
    // A face of the box and a wall of the room are 10 and 16 voxels wide.
    EXPECT_GT(known, 6 * (10 * 10 + 16 * 16) * 0.8);
  }
}

}  // namespace
}  // namespace lightloom::test
