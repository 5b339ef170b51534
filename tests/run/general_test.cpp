// Modelling only what a scene requires: the general case gives the same bits, and more work.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "framework/run/compile_graph.hpp"
#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

std::string small_graph(const char* name) {
  nlohmann::ordered_json graph = nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs" / name));
  graph["view"] = {{"width", 64}, {"height", 48}};
  graph["trace"] = graph["view"];
  graph["params"]["resolution"] = 24;
  return graph.dump();
}

/// A room corner with nothing but matt quads and a constant sky: as few features as a scene can have.
scene::Scene bare_scene() {
  scene::Scene scene = make_quad_scene({{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, {{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}}}, {},
                                       look_at({0.5f, 1, 2}, {0, 0.4f, 0}, 0.9f));
  scene.features.specular = false;
  scene.environment.radiance = {1, 0.8f, 0.6f};
  scene.features.environment = true;
  return scene;
}

class General : public DeviceTest {};

TEST_F(General, AllFeaturesGiveTheBitsOfThoseThatTheSceneHas) {
  const scene::Scene atrium = scene::load_scene(source_dir() / "samples/scenes/atrium.scene.json");
  const scene::Scene bare = bare_scene();
  for (const char* graph : {"paper.json", "lightloom.json"})
    for (const scene::Scene* scene : {&atrium, &bare}) {
      GraphRunOptions options;
      options.frames = 3;
      const Images required = run_graph(small_graph(graph), *scene, options).back();
      options.link.general = true;
      const Images general = run_graph(small_graph(graph), *scene, options).back();
      ASSERT_EQ(required.size(), general.size());
      for (const auto& [name, image] : required) {
        EXPECT_TRUE(image.texels == general.at(name).texels) << graph << " " << name;
        EXPECT_TRUE(
            std::any_of(image.texels.begin(), image.texels.end(), [](std::byte byte) { return byte != std::byte{0}; }))
            << graph << " " << name << " is black";
      }
    }
}

TEST_F(General, EveryPassRunsInEveryFrame) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  const scene::Scene bare = bare_scene();
  const auto plan_of = [&](bool general) {
    Diagnostics diagnostics;
    LinkOptions options;
    options.general = general;
    return run::compile_graph(source_dir() / "graphs/paper.json", registry, options, &bare, diagnostics).value();
  };
  const Plan required = plan_of(false);
  const Plan general = plan_of(true);
  EXPECT_GT(required.once.size(), 0u);
  EXPECT_EQ(general.once.size(), 0u);
  EXPECT_GT(required.graph.bypassed.size(), 0u);
  EXPECT_EQ(general.graph.bypassed.size(), 0u);
  EXPECT_EQ(general.steps.size(), 15u) << "all that the graph has";
}

}  // namespace
}  // namespace lightloom::test
