#include "framework/graph/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/base/file.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

constexpr uint64_t kWidth = 20, kHeight = 10, kPixels = kWidth * kHeight;

Graph paper(const std::vector<std::string>& captures = {}) {
  LinkOptions options;
  options.view = options.trace = std::pair<uint32_t, uint32_t>(kWidth, kHeight);
  options.captures = captures;
  return toy::graph_of(read_text_file(source_dir() / "graphs" / "paper.json"), options, real_passes());
}

const GraphPass& pass_of(const Graph& graph, const std::string& name) {
  return *std::find_if(graph.passes.begin(), graph.passes.end(),
                       [&](const GraphPass& pass) { return pass.name == name; });
}

PassTraffic traffic(const Graph& graph, const std::string& pass, const std::set<std::string>* bound = nullptr) {
  return traffic_of(graph, pass_of(graph, pass), bound);
}

// By hand: the G-buffer has three images of 16 bytes a pixel and five of 8; radiance has 16.
constexpr uint64_t kSurface = 3 * 16 + 5 * 8;

TEST(Traffic, OfATonemapIsItsInputAndItsPicture) {
  const PassTraffic tonemap = traffic(paper(), "tonemap");
  EXPECT_EQ(tonemap.bytes_read(), kPixels * 16);
  EXPECT_EQ(tonemap.bytes_written(), kPixels * 4);
  ASSERT_EQ(tonemap.texels.size(), 2u);
  EXPECT_EQ(tonemap.texels[0].format, Format::rgba8_unorm);
  EXPECT_EQ(tonemap.texels[0].written, kPixels);
}

TEST(Traffic, CountsEachLayerOfAHistoryAndScratchBothWays) {
  const Graph graph = paper();
  // This frame's radiance and surface; of the nine frames before, radiance, position, normal and id.
  EXPECT_EQ(traffic(graph, "temporal").bytes_read(), kPixels * (16 + kSurface + 9 * (16 + 16 + 8 + 16)));
  EXPECT_EQ(traffic(graph, "gather").bytes_written(), kPixels * (kSurface + 4 + 4)) << "and visibility and depth";
  EXPECT_EQ(traffic(graph, "gather").bytes_read(), kPixels * (4 + 4)) << "these two alone";
}

TEST(Traffic, LeavesOutWhatNeedNotBeTouched) {
  const Graph graph = paper(), counted = paper({"trace.counts"});
  EXPECT_EQ(traffic(graph, "trace").bytes_read(), kPixels * kSurface) << "rays look voxels up, here and there";
  EXPECT_EQ(traffic(graph, "trace").bytes_written(), kPixels * 16) << "nobody reads the others";
  EXPECT_EQ(traffic(counted, "trace").bytes_written(), kPixels * (16 + 8));
  const Extent3 grid = graph.values[pass_of(graph, "distance").outputs.front().value].desc.extent;
  EXPECT_GE(traffic(graph, "merge").bytes_read(), uint64_t{grid.width} * grid.height * grid.depth * 3 * 4)
      << "who writes a volume reads it whole";
}

TEST(Traffic, CountsOnlyWhatShadersBindWhereThatIsKnown) {
  const std::set<std::string> bound = {"radiance", "out_image"};
  EXPECT_EQ(traffic(paper(), "tonemap", &bound).bytes_read(), kPixels * 16);
  const std::set<std::string> none;
  EXPECT_EQ(traffic(paper(), "tonemap", &none).bytes_read(), 0u);
  EXPECT_EQ(traffic(paper(), "tonemap", &none).bytes_written(), kPixels * 4);
}

}  // namespace
}  // namespace lightloom
