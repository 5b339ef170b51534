#include <gtest/gtest.h>

#include "framework/stability/lab.hpp"
#include "framework/stability/scenes.hpp"
#include "framework/study/bench_record.hpp"
#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::study {
namespace {

BenchFigures figures(double scale) {
  BenchFigures made;
  made.name = "made up";
  made.passes = {"trace", "tonemap"};
  for (int frame = 0; frame < 20; ++frame) {
    const double noise = 1 + 0.01 * (frame % 5);
    made.frame_ms.push_back(10 * scale * noise);
    made.pass_ms.resize(2);
    made.pass_ms[0].push_back(8 * scale * noise);
    made.pass_ms[1].push_back(1);
  }
  return made;
}

TEST(BenchFigures, PassesAddUpFrameByFrame) {
  const std::vector<double> sums = sums_of_passes(figures(1));
  ASSERT_EQ(sums.size(), 20u);
  EXPECT_DOUBLE_EQ(sums[0], 9);
  EXPECT_DOUBLE_EQ(sums[1], 8 * 1.01 + 1);
  EXPECT_TRUE(sums_of_passes({}).empty());
}

TEST(BenchFigures, RaysASecondAreOverThePassesThatMarchedThem) {
  BenchFigures made = figures(1);
  EXPECT_EQ(per_second(1000, made), 0) << "nothing counted";
  made.rays = RayCounts{{"trace"}, 1000, 5000};
  EXPECT_NEAR(per_second(1000, made), 1000 / (8 * 1.02) * 1e3, 1e-6);
  made.rays->passes = {"elsewhere"};
  EXPECT_EQ(per_second(1000, made), 0);
}

TEST(BenchComparison, TellsADifferenceFromNoise) {
  const BenchComparison twice = compare_runs(figures(2), figures(1));
  EXPECT_NEAR(twice.frame.median, 2, 1e-9);
  EXPECT_FALSE(twice.frame.within_noise);
  ASSERT_EQ(twice.passes.size(), 2u);
  EXPECT_EQ(twice.passes[1].first, "tonemap");
  EXPECT_TRUE(twice.passes[1].second.within_noise);
}

constexpr const char* kGraph = R"({ "lightloom": 1, "name": "tiny", "view": { "width": 8, "height": 6 },
  "passes": {
    "voxelize": { "type": "voxelize", "params": { "geometry": "all", "resolution": 8 } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" },
    "trace": { "type": "voxel_path_trace", "params": { "paths": 2, "bounces": 1 },
               "in": { "surface": "gather.surface", "voxels": "voxelize.voxels", "distance": "distance.distance" } } },
  "outputs": { "radiance": "trace.radiance" } })";

class BenchOnDevice : public test::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    passes::register_builtin_passes(registry_);
    scene_ = stability::make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {},
                                        stability::look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
    scene_.environment.radiance = glm::vec3(1);
    scene_.features.environment = true;
  }

  [[nodiscard]] BenchRun run(const std::string& name, const LinkOptions& link = {}) {
    const run::ShaderFolders shaders = run::default_shader_folders();
    return {name,
            stability::Lab(device(), registry_, shaders).plan(kGraph, scene_, link),
            0.5,
            {.shaders = shaders, .camera = {}}};
  }

  PassRegistry registry_;
  scene::Scene scene_;
};

TEST_F(BenchOnDevice, MeasuresFramesAndPassesApart) {
  uint32_t calls = 0;
  const std::vector<BenchFigures> measured =
      measure(device(), scene_, {run("a"), run("b")}, {.first_frame = 3, .frames = 5, .warm_up = 2},
              [&](uint32_t done, uint32_t total) {
                EXPECT_EQ(total, 7u);
                EXPECT_EQ(done, ++calls);
              });
  ASSERT_EQ(measured.size(), 2u);
  EXPECT_EQ(measured[0].name, "a");
  EXPECT_EQ(measured[1].name, "b");
  for (const BenchFigures& figures : measured) {
    EXPECT_EQ(figures.frame_ms.size(), 5u);
    EXPECT_EQ(figures.passes, (std::vector<std::string>{"gather", "trace"})) << "the rest is hoisted";
    EXPECT_EQ(figures.once.size(), 2u);
    ASSERT_EQ(figures.pass_ms.size(), 2u);
    EXPECT_EQ(figures.pass_ms[0].size(), 5u);
    EXPECT_GT(figures.first_frame_ms, 0);
    EXPECT_GT(figures.value_bytes, 0u);
  }
}

TEST_F(BenchOnDevice, RaysAreCountedWhereTheyAreMarched) {
  LinkOptions link;
  link.captures = {"*.counts"};
  const BenchRun counting = run("counting", link);
  run::Executor executor(device(), counting.plan, scene_, counting.options);
  const run::FrameResult frame = executor.run_frame(0);
  const RayCounts counts = count_rays(frame);
  EXPECT_EQ(counts.passes, std::vector<std::string>{"trace"});
  // Two paths a lit pixel march at least one ray each, and each ray at least one step.
  EXPECT_GE(counts.rays, 2);
  EXPECT_LE(counts.rays, 8 * 6 * 2 * 8);
  EXPECT_GE(counts.steps, counts.rays);
}

TEST_F(BenchOnDevice, FramesWithoutTimesHaveTheSameBits) {
  const BenchRun timed = run("timed");
  run::Executor a(device(), timed.plan, scene_, timed.options), b(device(), timed.plan, scene_, timed.options);
  for (uint32_t frame = 0; frame < 4; ++frame) {
    const run::FrameResult with = a.run_frame(frame);
    const run::FrameResult mixed = b.run_frame(frame, {.times = frame % 2 == 1});
    EXPECT_EQ(with.outputs.at(0).image.texels, mixed.outputs.at(0).image.texels);
    ASSERT_EQ(mixed.times.size(), with.times.size());
    for (size_t pass = 0; pass < with.times.size(); ++pass) {
      EXPECT_EQ(mixed.times[pass].milliseconds >= 0, with.times[pass].milliseconds >= 0 && frame % 2 == 1);
    }
  }
}

}  // namespace
}  // namespace lightloom::study
