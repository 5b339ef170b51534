#include "framework/run/device_needs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::run {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

gpu::DeviceInfo device(const std::string& missing) {
  gpu::DeviceInfo info;
  info.name = "toy device";
  info.ray_query = {.available = missing.empty(), .missing = missing};
  return info;
}

Graph graph_with(const PassType& type) {
  Graph graph;
  GraphPass pass;
  pass.name = "trace";
  pass.type = &type;
  graph.passes = {pass};
  return graph;
}

PassType ray_type() {
  PassType type;
  type.name = "toy_tracer";
  type.needs.ray_query = true;
  return type;
}

TEST(DeviceNeeds, PassesThatAskForRaysAreRefusedByNameWhereTheDeviceHasNone) {
  const PassType type = ray_type();
  try {
    require_device_needs(graph_with(type), device("VK_KHR_ray_query, the feature rayQuery"));
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_device);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("pass 'trace' (toy_tracer) needs VK_KHR_ray_query"),
                                    HasSubstr("device 'toy device' lacks VK_KHR_ray_query, the feature rayQuery")));
    EXPECT_THAT(error.hint(), HasSubstr("--swap trace=reference_path_trace"));
  }
}

TEST(DeviceNeeds, OtherwiseThereIsNothingToRefuse) {
  const PassType needy = ray_type(), plain;
  EXPECT_NO_THROW(require_device_needs(graph_with(needy), device("")));
  EXPECT_NO_THROW(require_device_needs(graph_with(plain), device("VK_KHR_ray_query")));
  EXPECT_TRUE(needs_ray_queries(graph_with(needy)));
  EXPECT_FALSE(needs_ray_queries(graph_with(plain)));
}

class DeviceNeedsOfRuns : public test::DeviceTest {};

TEST_F(DeviceNeedsOfRuns, TheTracerIsRefusedBeforeAnythingRuns) {
  if (DeviceNeedsOfRuns::device().info().ray_query.available) GTEST_SKIP() << "this device has ray queries";
  const std::string graph = R"({ "lightloom": 1, "name": "test", "view": { "width": 8, "height": 8 },
    "trace": { "width": 8, "height": 8 }, "passes": { "gather": { "type": "gather" },
    "trace": { "type": "ray_query_path_trace", "in": { "surface": "gather.surface" } } },
    "outputs": { "radiance": "trace.radiance" } })";
  try {
    static_cast<void>(test::run_graph(graph, toy::one_quad()));
    FAIL() << "ran";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_device);
    EXPECT_THAT(error.what(), HasSubstr("pass 'trace' (ray_query_path_trace)"));
  }
}

}  // namespace
}  // namespace lightloom::run
