// Persistent ports on the device: what a pass leaves in an image is there a frame later.
#include <gtest/gtest.h>

#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::run {
namespace {

using test::GraphRunOptions;
using test::Images;

/// Writes all of its two images, or, where both were kept, the column that is new in the frame.
PassType frontier_type(bool partial, std::vector<bool>& kept) {
  PassType type;
  type.name = "test_frontier";
  type.doc = "For tests.";
  type.ports = {toy::image_port("front", Direction::out), toy::image_port("memo", Direction::scratch)};
  type.ports[1].parts = {{"", Format::r32_uint, ""}};
  type.ports[1].access = Access::compute_storage_read_write;
  for (Port& port : type.ports) port.persistent = partial;
  type.reads = FrameState::time;
  type.record = [partial, &kept](PassContext& context) {
    const Extent3 all = context.output_extent("front");
    const bool rest = partial && context.kept("front") && context.kept("memo");
    kept.push_back(partial && context.kept("front"));
    const uint32_t columns = rest ? 1 : all.width;
    context.dispatch({"test_frontier.comp", {columns, all.height, 1}, {{"columns", columns}}});
  };
  return type;
}

PassType reader_type() {
  return toy::one_shader_type("test_counter",
                              {toy::image_port("previous", Direction::in), toy::image_port("count", Direction::out)},
                              "test_counter.comp", "count");
}

std::string graph(const std::string& edge) {
  return R"({ "lightloom": 1, "name": "frontier",
    "view": { "width": 24, "height": 7 }, "trace": { "width": 24, "height": 7 },
    "passes": {
      "frontier": { "type": "test_frontier" },
      "reader": { "type": "test_counter", "in": { "previous": ")" +
         edge + R"(" } }
    },
    "outputs": { "seen": "reader.count" } })";
}

struct FrontierRun {
  std::vector<Images> frames;
  std::vector<bool> kept;
};

class PersistentTest : public test::DeviceTest {
 protected:
  static FrontierRun run(bool partial, const std::string& edge, const std::vector<std::string>& capture) {
    FrontierRun result;
    PassType reader = reader_type();
    reader.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
    GraphRunOptions options;
    options.frames = 8;
    options.capture = capture;
    options.extra_types = {frontier_type(partial, result.kept), reader};
    result.frames = run_graph(graph(edge), toy::one_quad(), options);
    return result;
  }
};

TEST_F(PersistentTest, APartialRewriteEqualsAFullOne) {
  for (const std::vector<std::string>& capture : {std::vector<std::string>{}, std::vector<std::string>{"*"}}) {
    const FrontierRun partial = run(true, "frontier.front", capture);
    const FrontierRun full = run(false, "frontier.front", capture);
    EXPECT_EQ(partial.kept, (std::vector<bool>{false, true, true, true, true, true, true, true}));
    for (size_t frame = 0; frame < 8; ++frame) {
      ASSERT_EQ(partial.frames[frame].size(), capture.empty() ? 1U : 4U);
      for (const auto& [name, image] : full.frames[frame])
        EXPECT_EQ(partial.frames[frame].at(name).texels, image.texels) << name << " in frame " << frame;
    }
    for (uint32_t x = 0; x < 24; ++x)
      EXPECT_EQ(partial.frames[7].at("seen").at(x, 6, 0, 0), (x <= 7 ? 1.0 + x : 0.0) + 1.0) << x;
  }
}

TEST_F(PersistentTest, NothingIsKeptOfAValueWithAHistory) {
  const FrontierRun partial = run(true, "frontier.front@1", {"frontier.front"});
  const FrontierRun full = run(false, "frontier.front@1", {"frontier.front"});
  EXPECT_EQ(partial.kept, std::vector<bool>(8, false));
  for (size_t frame = 0; frame < 8; ++frame)
    for (const auto& [name, image] : full.frames[frame])
      EXPECT_EQ(partial.frames[frame].at(name).texels, image.texels) << name << " in frame " << frame;
}

}  // namespace
}  // namespace lightloom::run
