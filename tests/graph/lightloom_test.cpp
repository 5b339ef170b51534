#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "framework/base/file.hpp"
#include "framework/graph/verify.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

// graphs/lightloom.json, linked against scenes that have or lack what its nodes ask for.
namespace lightloom {
namespace {

Graph lightloom_graph(const LinkOptions& options = {}, bool specular = true, bool dynamic = true) {
  LinkEnvironment scene = toy::environment(dynamic);
  scene.scene_features.emplace_back("specular", specular);
  scene.scene_features.emplace_back("emissive", dynamic);
  return toy::graph_of(read_text_file(source_dir() / "graphs" / "lightloom.json"), options, real_passes(), scene);
}

bool runs(const Graph& graph, const std::string& name) {
  const auto order = toy::order(compile(graph));
  return std::find(order.begin(), order.end(), name) != order.end();
}

TEST(LightloomGraph, LobesAreFilteredApartByTheSamePassTypes) {
  const Graph graph = lightloom_graph();
  for (const std::string lobe : {"diffuse", "specular"}) {
    EXPECT_EQ(toy::source(graph, "temporal_" + lobe, "radiance"), "trace." + lobe);
    for (const std::string stage : {"tangent", "bitangent", "box_x", "box_y"}) {
      const std::string name = "denoise_" + lobe + "_" + stage;
      EXPECT_EQ(toy::pass(graph, name).params.choice("lobe"), lobe);
      EXPECT_EQ(toy::source(graph, name, "guide"), "guide_" + lobe + ".guide");
    }
    EXPECT_EQ(toy::source(graph, "guide_" + lobe, "variance"), "temporal_" + lobe + ".variance");
  }
  EXPECT_EQ(toy::source(graph, "upsample", "radiance"), "denoise_diffuse_box_y.radiance");
  EXPECT_EQ(toy::source(graph, "upsample", "specular"), "denoise_specular_box_y.radiance");
  EXPECT_EQ(toy::source(graph, "modulate", "specular"), "upsample.specular");
}

TEST(LightloomGraph, WhatIsOptionalRunsWhereItIsAskedForAlone) {
  std::vector<std::string> culled;
  for (const PassRemark& remark : lightloom_graph().culled) culled.push_back(remark.pass);
  EXPECT_THAT(culled, testing::UnorderedElementsAre("cache", "moved", "reservoirs", "reuse"));
  LinkOptions options;
  options.variants = {"cached", "reservoirs"};
  const Graph all = lightloom_graph(options);
  EXPECT_TRUE(all.culled.empty());
  EXPECT_EQ(toy::source(all, "trace", "cache"), "cache.light");
  EXPECT_EQ(toy::source(all, "trace", "reservoir"), "reuse.reservoir");
}

TEST(LightloomGraph, WithoutSpecularReflectionItsChainFallsAway) {
  const Graph graph = lightloom_graph({}, false, false);
  EXPECT_FALSE(runs(graph, "temporal_specular"));
  for (const char* stage : {"tangent", "bitangent", "box_x", "box_y"}) {
    EXPECT_FALSE(runs(graph, std::string("denoise_specular_") + stage));
    EXPECT_TRUE(runs(graph, std::string("denoise_diffuse_") + stage));
  }
  EXPECT_FALSE(runs(graph, "merge"));
  EXPECT_TRUE(runs(graph, "modulate"));
}

TEST(LightloomGraph, DisabledFiltersLeaveTheirInput) {
  LinkOptions options;
  options.disables = {"denoise_*"};
  const Graph graph = lightloom_graph(options);
  EXPECT_EQ(toy::source(graph, "upsample", "radiance"), "temporal_diffuse.radiance");
  EXPECT_EQ(toy::source(graph, "upsample", "specular"), "temporal_specular.radiance");
  options.disables = {"denoise_*", "temporal_*"};
  EXPECT_EQ(toy::source(lightloom_graph(options), "upsample", "specular"), "trace.specular");
}

TEST(LightloomGraph, EveryVariantAndEveryStageAloneLinksWithoutHazard) {
  const std::vector<std::string> disabled = {"denoise_*",       "denoise_*_tangent", "denoise_diffuse_*",
                                             "denoise_*_box_*", "temporal_*",        "temporal_specular",
                                             "modulate",        "trace_surface",     "denoise_*_box_y"};
  for (const bool specular : {false, true}) {
    for (const std::string& glob : disabled) {
      LinkOptions options;
      options.disables = {glob};
      options.captures = {"*"};
      EXPECT_EQ(verify(compile(lightloom_graph(options, specular)), {}, 1).violations, std::vector<std::string>{})
          << glob;
    }
    for (const char* variant : {"no_denoise", "no_temporal", "raw", "paths15", "cached", "reservoirs", "isotropic"}) {
      LinkOptions options;
      options.variants = {variant};
      EXPECT_EQ(verify(compile(lightloom_graph(options, specular)), {}, 1).violations, std::vector<std::string>{})
          << variant;
    }
  }
}

TEST(LightloomGraph, TrianglesTakeThePlaceOfVoxels) {
  LinkOptions options;
  options.swaps = {{"trace", "ray_query_path_trace"}};
  const Graph graph = lightloom_graph(options);
  for (const char* voxels : {"voxelize_static", "voxelize_dynamic", "merge", "distance", "emissive_faces"})
    EXPECT_FALSE(runs(graph, voxels)) << voxels;
  for (const char* rest : {"gather", "trace_surface", "trace", "temporal_diffuse", "temporal_specular", "modulate"})
    EXPECT_TRUE(runs(graph, rest)) << rest;
  EXPECT_EQ(toy::pass(graph, "trace").params.choice("ward"), "bounded");
  EXPECT_EQ(toy::pass(graph, "trace").params.choice("environment_sampling"), "image");
}

}  // namespace
}  // namespace lightloom
