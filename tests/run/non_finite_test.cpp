// Who made the first NaN: toy passes that plant one at a chosen pixel of a chosen frame, in the middle of a chain.
#include "framework/run/non_finite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run/observed_run.hpp"

namespace lightloom::run {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using toy::image_port;

PassType ramp_type() {
  return toy::one_shader_type("test_ramp", {image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp");
}

PassType counter_type() {
  PassType type =
      toy::one_shader_type("test_counter", {image_port("previous", Direction::in), image_port("count", Direction::out)},
                           "test_counter.comp", "count");
  type.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
  return type;
}

PassType plant_type() {
  PassType type = toy::one_shader_type("test_plant", {image_port("x", Direction::in), image_port("y", Direction::out)},
                                       "test_plant.comp", "y");
  type.reads = FrameState::time;
  for (const char* name : {"column", "row", "in_frame", "kind"})
    type.params.push_back({name, ParamType::integer, int64_t{0}, {}, {}, {}, "", ""});
  return type;
}

/// ramp -> plant (NaN at 17,5 in frame 2) -> next -> last; `trail` reads what plant made two frames ago; `sum` keeps
/// what it once had.
constexpr const char* kChain = R"({ "lightloom": 1, "name": "chain",
  "view": { "width": 20, "height": 9 }, "trace": { "width": 20, "height": 9 },
  "passes": {
    "ramp": { "type": "test_ramp" },
    "plant": { "type": "test_plant", "in": { "x": "ramp.ramp" },
               "params": { "column": 17, "row": 5, "in_frame": 2, "kind": 0 } },
    "next": { "type": "test_counter", "in": { "previous": "plant.y" } },
    "trail": { "type": "test_counter", "in": { "previous": "plant.y@2" } },
    "last": { "type": "test_counter", "in": { "previous": "next.count" } }
  },
  "outputs": { "last": "last.count", "trail": "trail.count" } })";

class NonFiniteTest : public test::DeviceTest {
 protected:
  static NonFiniteWatch watched(const toy::ObservedGraph& graph, const std::vector<FrameResult>& results) {
    NonFiniteWatch watch(graph.plan);
    for (const FrameResult& result : results) watch.add(result.frame, result.scanned);
    return watch;
  }
  static std::vector<PassType> types() { return {ramp_type(), counter_type(), plant_type()}; }
};

TEST_F(NonFiniteTest, ThePassFramePixelAndValueAreNamed) {
  const scene::Scene quad = toy::one_quad();
  for (const int kind : {0, 1}) {
    LinkOptions link;
    link.sets = {{"plant.kind", std::to_string(kind)}};
    const toy::ObservedGraph graph(kChain, types(), quad, link);
    const NonFiniteWatch watch = watched(graph, toy::run_frames(graph.plan, quad, 6, toy::observed_options()));
    ASSERT_EQ(watch.found().size(), 1U);
    const NonFinite& made = watch.found().front();
    EXPECT_EQ(made.pass, "plant");
    EXPECT_EQ(made.value, "plant.y");
    EXPECT_EQ(made.frames.text(), "frame 2");
    EXPECT_EQ(made.seen.nan_texels, kind == 0 ? 1U : 0U);
    EXPECT_EQ(made.seen.infinite_texels, kind == 0 ? 0U : 1U);
    EXPECT_EQ(made.seen.first_bad, 5U * 20 + 17);
    EXPECT_THAT(watch.warnings(), ElementsAre(std::string("plant.y: plant made ") + (kind == 0 ? "NaN" : "infinity") +
                                              " in 1 of 180 texels, first at 17,5, (" + (kind == 0 ? "nan" : "inf") +
                                              "); frame 2; all that it read was finite: ramp.ramp"));
    EXPECT_EQ(watch.record().dump(),
              std::string(R"({"made":[{"value":"plant.y","pass":"plant","frames":[[2,2]],"nan_texels":)") +
                  (kind == 0 ? "1" : "0") + R"(,"infinite_texels":)" + (kind == 0 ? "0" : "1") +
                  R"(,"texels":180,"first":[17,5],"texel":[")" + (kind == 0 ? "nan" : "inf") +
                  R"("],"finite_inputs":["ramp.ramp"]}],"passed_on":["last.count","next.count","trail.count"]})");
  }
}

/// Round and round: a NaN of frame 1 stays in the sum for ever.
constexpr const char* kSum = R"({ "lightloom": 1, "name": "sum",
    "view": { "width": 20, "height": 9 }, "trace": { "width": 20, "height": 9 },
    "passes": {
      "plant": { "type": "test_plant", "in": { "x": "sum.count@1" },
                 "params": { "column": 0, "row": 0, "in_frame": 1, "kind": 0 } },
      "sum": { "type": "test_counter", "in": { "previous": "plant.y" } }
    },
    "outputs": { "sum": "sum.count" } })";

TEST_F(NonFiniteTest, WhoHasItFromAnEarlierFrameIsNotNamed) {
  // All readers of the sum have the NaN from there.
  const scene::Scene quad = toy::one_quad();
  const toy::ObservedGraph graph(kSum, types(), quad);
  const std::vector<FrameResult> results = toy::run_frames(graph.plan, quad, 5, toy::observed_options());
  for (const FrameResult& result : results) {
    const ScannedValue* seen = toy::find_scan(result, graph.id("sum.count"));
    ASSERT_NE(seen, nullptr);
    EXPECT_EQ(seen->nan_texels, result.frame >= 1 ? 1U : 0U);
  }
  const NonFiniteWatch watch = watched(graph, results);
  ASSERT_EQ(watch.found().size(), 1U);
  EXPECT_EQ(watch.found()[0].value, "plant.y");
  EXPECT_EQ(watch.found()[0].frames.text(), "frame 1");
}

TEST_F(NonFiniteTest, AResumedRunKnowsWhatItStartsFrom) {
  const scene::Scene quad = toy::one_quad();
  const toy::ObservedGraph graph(kSum, types(), quad);
  Executor first(device(), graph.plan, quad, toy::observed_options());
  for (uint32_t frame = 0; frame < 3; ++frame) static_cast<void>(first.run_frame(frame));
  const ExecutorState state = first.save();
  for (const bool told : {true, false}) {
    Executor second(device(), graph.plan, quad, toy::observed_options());
    second.restore(state);
    NonFiniteWatch watch(graph.plan);
    if (told) watch.resume(state);
    const FrameResult result = second.run_frame(3);
    watch.add(3, result.scanned);
    EXPECT_EQ(watch.found().size(), told ? 0U : 1U);
  }
}

TEST_F(NonFiniteTest, AConstantMayBeInfiniteByDesign) {
  std::vector<PassType> with_bypass = types();
  with_bypass[0].ports[0].bypass = Bypass{"", {std::numeric_limits<float>::infinity(), 0, 0, 0}};
  const scene::Scene quad = toy::one_quad();
  LinkOptions link;
  link.disables = {"ramp"};
  const toy::ObservedGraph graph(kChain, with_bypass, quad, link);
  const NonFiniteWatch watch = watched(graph, toy::run_frames(graph.plan, quad, 4, toy::observed_options()));
  EXPECT_TRUE(watch.found().empty()) << "plant had it from the constant";
}

TEST_F(NonFiniteTest, WatchingChangesNoBit) {
  const scene::Scene quad = toy::one_quad();
  LinkOptions link;
  link.captures = {"*"};
  const toy::ObservedGraph watched_graph(kChain, types(), quad, link);
  const toy::ObservedGraph plain_graph(kChain, types(), quad, link, false);
  const std::vector<FrameResult> watched_frames = toy::run_frames(watched_graph.plan, quad, 6, toy::observed_options());
  const std::vector<FrameResult> plain_frames = toy::run_frames(plain_graph.plan, quad, 6, toy::observed_options());
  EXPECT_TRUE(plain_frames[0].scanned.empty());
  EXPECT_EQ(watched_frames[0].scanned.size(), 5U);
  toy::expect_same_images(plain_frames, watched_frames);
}

}  // namespace
}  // namespace lightloom::run
