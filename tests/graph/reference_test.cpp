// graphs/reference.json, and the reference tracer in the place of others.
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/base/file.hpp"
#include "framework/graph/verify.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

Graph graph_of_file(const std::string& name, const LinkOptions& options, bool dynamic) {
  LinkEnvironment scene = toy::environment(dynamic);
  scene.scene_features.emplace_back("specular", true);
  scene.scene_features.emplace_back("emissive", true);
  return toy::graph_of(read_text_file(source_dir() / "graphs" / name), options, real_passes(), scene);
}

std::vector<std::string> culled(const Graph& graph) {
  std::vector<std::string> names;
  for (const PassRemark& remark : graph.culled) names.push_back(remark.pass);
  std::sort(names.begin(), names.end());
  return names;
}

TEST(ReferenceGraph, RunsWithoutHazard) {
  const Plan plan = compile(graph_of_file("reference.json", {}, true));
  EXPECT_EQ(verify(plan).violations, std::vector<std::string>{});
  EXPECT_EQ(culled(plan.graph), std::vector<std::string>{"voxelize"});
  LinkOptions voxels;
  voxels.type_sets = {{"--geometry", "reference_path_trace", "geometry", "voxels"}};
  const Plan through = compile(graph_of_file("reference.json", voxels, true));
  EXPECT_EQ(verify(through).violations, std::vector<std::string>{});
  EXPECT_TRUE(through.graph.culled.empty());
  EXPECT_EQ(toy::source(through.graph, "trace", "voxels", "albedo"), "voxelize.voxels.albedo");
}

TEST(ReferenceGraph, TakesThePlaceOfAnyTracerAndCullsItsVoxels) {
  LinkOptions options;
  options.swaps = {{"trace", "reference_path_trace"}};
  for (const bool dynamic : {false, true}) {
    std::vector<std::string> voxels = {"distance", "voxelize_static"};
    if (dynamic) voxels = {"distance", "merge", "voxelize_dynamic", "voxelize_static"};
    const Graph paper = graph_of_file("paper.json", options, dynamic);
    EXPECT_EQ(culled(paper), voxels);
    EXPECT_EQ(toy::pass(paper, "trace").params.choice("ward"), "1992");
    EXPECT_EQ(toy::source(paper, "trace", "surface", "id"), "trace_surface.surface.id");
    EXPECT_EQ(verify(compile(paper)).violations, std::vector<std::string>{});
    const Graph better = graph_of_file("lightloom.json", options, dynamic);
    const std::vector<std::string> gone = culled(better);
    EXPECT_TRUE(std::includes(gone.begin(), gone.end(), voxels.begin(), voxels.end()));
    EXPECT_EQ(toy::pass(better, "trace").params.choice("ward"), "bounded");
    EXPECT_EQ(verify(compile(better)).violations, std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace lightloom
