#include "framework/graph/plan_dot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/graph/real_passes.hpp"
#include "tests/support/random_graph.hpp"
#include "tests/support/schema_check.hpp"
#include "tests/support/toy_graphs.hpp"

// Drawings are given to Graphviz itself.
namespace lightloom {
namespace {

/// The drawing as SVG, with dots for what Graphviz writes as entities.
std::string svg_of(const Plan& plan) {
  const test::SchemaFolder folder;
  const std::filesystem::path drawing = folder.write("plan.dot", plan_dot(plan));
  const std::string out = drawing.string() + ".svg";
  const std::string errors = drawing.string() + ".errors";
  const int status = std::system(("dot -Tsvg '" + drawing.string() + "' -o '" + out + "' 2> '" + errors + "'").c_str());
  EXPECT_EQ(status, 0) << read_text_file(errors);
  EXPECT_EQ(read_text_file(errors), "");
  return status == 0 ? read_text_file(out) : "";
}

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(PlanDot, GraphvizDrawsEveryPass) {
  LinkOptions options;
  options.disables = {"denoise_box_x"};
  const std::string text = read_text_file(source_dir() / "graphs/paper.json");
  const Plan plan = compile(toy::graph_of(text, options, real_passes()));
  const std::string svg = svg_of(plan);
  EXPECT_EQ(count(svg, "class=\"cluster\""), 1U) << "what runs once";
  for (const auto* steps : {&plan.once, &plan.steps})
    for (const PlanStep& step : *steps)
      EXPECT_NE(svg.find(". " + plan.graph.passes[step.pass].name + "</text>"), std::string::npos);
  EXPECT_NE(svg.find(">denoise_box_x</text>"), std::string::npos);
  EXPECT_NE(svg.find(">bypassed</text>"), std::string::npos);
  EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos) << "history edges";
  EXPECT_NE(svg.find(">trail@1..9</text>"), std::string::npos);
}

TEST(PlanDot, AnyGraphAndAnyNameIsDrawn) {
  for (uint32_t seed = 0; seed < 4; ++seed) (void)svg_of(toy::plan_of(toy::random_graph(seed, 12)));
  Plan plan = toy::plan_of(toy::random_graph(5, 8));
  plan.graph.name = "a \"graph\" \\ with <odd> & \n marks; } ]";
  plan.graph.culled.push_back({"x", "because \"of\" it\\"});
  EXPECT_NE(svg_of(plan).find("because &quot;of&quot; it"), std::string::npos);
}

}  // namespace
}  // namespace lightloom
