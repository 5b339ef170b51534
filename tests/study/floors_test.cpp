#include "framework/study/floors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom::study {
namespace {

Plan traced_plan() {
  static const PassRegistry types = [] {
    PassRegistry made;
    passes::register_builtin_passes(made);
    return made;
  }();
  return compile(toy::graph_of(R"({ "lightloom": 1, "name": "traced", "view": { "width": 100, "height": 50 },
    "passes": {
      "voxelize": { "type": "voxelize", "params": { "geometry": "all", "resolution": 64 } },
      "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
      "gather": { "type": "gather" },
      "trace": { "type": "voxel_path_trace",
                 "in": { "surface": "gather.surface", "voxels": "voxelize.voxels", "distance": "distance.distance" } },
      "tonemap": { "type": "tonemap", "in": { "radiance": "trace.radiance" } } },
    "outputs": { "image": "tonemap.image" } })",
                               {}, types, toy::environment(false)));
}

const PassFloor& floor_of(const std::vector<PassFloor>& floors, const std::string& pass) {
  return *std::find_if(floors.begin(), floors.end(), [&](const PassFloor& floor) { return floor.pass == pass; });
}

DeviceRates made_up_rates() {
  DeviceRates rates;
  rates.copy = {.in_cache = 9e9, .in_memory = 1e9, .transfer = 2e9};
  rates.loads = {{Format::rgba8_unorm, 1e9}, {Format::rgba32_sfloat, 1e8}};
  rates.stores = {{Format::rgba8_unorm, 1e7}, {Format::rgba32_sfloat, 1e8}};
  rates.fetches = {{.side = 64, .marching = 1e6, .scattered = 1}, {.side = 512, .marching = 1e3, .scattered = 1}};
  rates.dispatch = 1e-6;
  return rates;
}

TEST(Floors, AreTheLargestOfWhatEachBoundTakes) {
  BenchFigures figures;
  figures.passes = {"gather", "trace", "tonemap"};
  figures.pass_ms = {{1}, {30}, {3, 1, 2}};
  figures.rays = RayCounts{{"trace"}, 1000, 5000, {5000}};
  const Plan plan = traced_plan();
  const std::vector<PassFloor> floors = floors_of(plan, figures, made_up_rates());
  ASSERT_EQ(floors.size(), plan.steps.size());

  const PassFloor& tonemap = floor_of(floors, "tonemap");
  EXPECT_EQ(tonemap.bytes_read, 5000u * 16);
  EXPECT_EQ(tonemap.bytes_written, 5000u * 4);
  EXPECT_NEAR(tonemap.bytes_ms, 5000 * 20 / 2e9 * 1e3, 1e-9) << "at the better of the large copies";
  EXPECT_NEAR(tonemap.texels_ms, (5000 / 1e8 + 5000 / 1e7) * 1e3, 1e-9);
  EXPECT_EQ(tonemap.steps_ms, 0);
  EXPECT_EQ(tonemap.bound(), "texels");
  EXPECT_EQ(tonemap.floor_ms(), tonemap.texels_ms);
  EXPECT_NEAR(tonemap.ratio(), 2 / tonemap.texels_ms, 1e-9);

  const PassFloor& trace = floor_of(floors, "trace");
  EXPECT_NEAR(trace.steps_ms, 5, 1e-9) << "at the rate of the volume that is nearest in size";
  EXPECT_EQ(trace.bound(), "steps");
  EXPECT_NEAR(trace.ratio(), 6, 1e-9);
}

TEST(Floors, JsonHasEachBoundOfEachPass) {
  const nlohmann::ordered_json json = floors_json(floors_of(traced_plan(), {}, made_up_rates()));
  ASSERT_TRUE(json.contains("tonemap"));
  for (const char* key : {"bytes_read", "bytes_written", "bytes_ms", "texels_ms", "steps_ms", "dispatch_ms", "floor_ms",
                          "bound", "measured_ms", "ratio"})
    EXPECT_TRUE(json["tonemap"].contains(key)) << key;
  EXPECT_EQ(json["tonemap"]["measured_ms"], 0) << "of a device without timestamps";
}

class Rates : public test::DeviceTest {};

TEST_F(Rates, ArePositiveAndCachesAreNoSlowerThanMemory) {
  const auto library = run::make_library(device(), run::default_shader_folders());
  const DeviceRates rates =
      measure_rates(device(), *library, {64, 64, 1}, {Format::rgba8_unorm, Format::rg32_uint, Format::d32_sfloat});
  EXPECT_GT(rates.copy.in_memory, 0);
  EXPECT_GT(rates.copy.transfer, 0);
  EXPECT_GE(rates.copy.best(), rates.copy.in_memory);
  EXPECT_EQ(rates.loads.size(), 2u) << "depth formats are left out";
  for (const auto* texels : {&rates.loads, &rates.stores})
    for (const auto& [format, rate] : *texels) EXPECT_GT(rate, 0) << format_info(format).name;
  ASSERT_GE(rates.fetches.size(), 2u);
  for (const FetchRates& rate : rates.fetches) {
    EXPECT_GT(rate.marching, 0) << rate.side;
    EXPECT_GT(rate.scattered, 0) << rate.side;
  }
  EXPECT_GT(rates.flops, 0);
  EXPECT_GT(rates.invocations, 0);
  EXPECT_GT(rates.dispatch, 0);
  // With a margin for a machine that does something else as well.
  EXPECT_GE(rates.copy.in_cache, 0.7 * rates.copy.in_memory);
  EXPECT_GE(rates.fetches.front().scattered, 0.7 * rates.fetches.back().scattered);
  EXPECT_GE(rates.fetches.front().marching, 0.7 * rates.fetches.back().marching);
  const nlohmann::ordered_json json = rates_json(rates);
  EXPECT_EQ(json["load_texels_per_second"].size(), 2u);
  EXPECT_EQ(json["volume_fetches_per_second"].size(), rates.fetches.size());
}

}  // namespace
}  // namespace lightloom::study
