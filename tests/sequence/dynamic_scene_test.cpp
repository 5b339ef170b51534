#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/scene/gltf_builder.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/graph_runner.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kWidth = 64;
constexpr uint32_t kHeight = 48;
constexpr uint32_t kFrames = 240;
constexpr uint32_t kWarmUp = 60;  // frames until all that is made on demand has been made
constexpr size_t kWindow = 10;    // frames of history, the current one included
constexpr double kAllowedGrowth = 8.0 * 1024 * 1024;

class DynamicScene : public DeviceTest {};

/// Memory of the process that is in use [bytes]. A software device takes its memory from the same process.
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// The paper's pipeline at a small size; all light is kept as long as that of a Lambertian surface, so that weights
/// count frames.
std::string small_paper_graph() {
  std::ifstream file(source_dir() / "graphs/paper.json");
  nlohmann::json graph = nlohmann::json::parse(file);
  graph["view"] = {{"width", kWidth}, {"height", kHeight}};
  graph["trace"] = graph["view"];
  graph["params"]["resolution"] = 32;
  graph["passes"]["temporal"]["params"]["lobe"] = "diffuse";
  graph["outputs"] = {{"accumulated", "temporal.radiance"}, {"id", "gather.surface.id"}, {"image", "tonemap.image"}};
  return graph.dump();
}

/// What the frames showed, and how that compares with the weights.
class HistoryCheck {
 public:
  explicit HistoryCheck(const scene::Scene& scene) : static_triangles_(scene.static_triangle_count) {}

  void add(uint32_t frame, Images images) {
    ids_.push_front(std::move(images.at("id")));
    if (ids_.size() > kWindow) ids_.pop_back();
    const image::HostImage& accumulated = images.at("accumulated");
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) check_pixel(frame, x, y, accumulated.at(x, y, 0, 3));
  }

  double pixels = 0;                  ///< compared, of what stands still
  double disoccluded = 0;             ///< of them with less than the whole history
  double moving = 0, moving_sum = 0;  ///< pixels of what moves, and the sum of their weights
  int wrong = 0;

 private:
  [[nodiscard]] std::pair<double, double> object(size_t age, uint32_t x, uint32_t y) const {
    return {ids_[age].at(x, y, 0, 0), ids_[age].at(x, y, 0, 1)};
  }

  /// The camera stands still, so what stands still was seen in the same pixel or not at all.
  void check_pixel(uint32_t frame, uint32_t x, uint32_t y, double weight) {
    if (weight <= 0) return;
    if (ids_[0].at(x, y, 0, 2) >= static_triangles_) {
      ++moving;
      moving_sum += weight;
      return;
    }
    double seen = 1;
    for (size_t age = 1; age < ids_.size(); ++age) seen += object(age, x, y) == object(0, x, y) ? 1 : 0;
    ++pixels;
    disoccluded += seen < static_cast<double>(ids_.size()) ? 1 : 0;
    if (weight == seen || ++wrong > 5) return;
    ADD_FAILURE() << "frame " << frame << ", pixel " << x << ' ' << y << ": weight " << weight << " where " << seen
                  << " frames saw the point";
  }

  double static_triangles_;
  std::deque<image::HostImage> ids_;  ///< newest first
};

TEST_F(DynamicScene, TwoHundredAndFortyFramesLeaveNoGhostAndTakeNoMoreMemory) {
  LIGHTLOOM_NEED_SHARED(scenes);
  const scene::Scene scene = scene::load_scene(scenes / "sponza_dynamic.scene.json");
  GraphRunOptions options;
  options.frames = kFrames;
  options.camera = "low";
  HistoryCheck history(scene);
  double warm = 0;
  visit_frames(small_paper_graph(), scene, options, [&](uint32_t frame, Images images) {
    history.add(frame, std::move(images));
    if (frame == kWarmUp) warm = resident_bytes();
  });
  const double growth = resident_bytes() - warm;
  EXPECT_LT(growth, kAllowedGrowth) << "since frame " << kWarmUp;
  EXPECT_EQ(history.wrong, 0);
  EXPECT_GT(history.pixels, 0.8 * kFrames * kWidth * kHeight);
  EXPECT_GT(history.disoccluded, 10.0 * kFrames);
  EXPECT_GT(history.moving, 10.0 * kFrames);
  EXPECT_GT(history.moving_sum / history.moving, 4) << "what moves keeps its history";
  RecordProperty("growth_bytes", static_cast<int>(growth));
  std::printf(
      "grown by %.0f KiB from %.0f MiB; %.0f still pixels, %.0f of them disoccluded; mean weight of what moves %.2f "
      "over %.0f pixels\n",
      growth / 1024, warm / 1024 / 1024, history.pixels, history.disoccluded, history.moving_sum / history.moving,
      history.moving);
}

}  // namespace
}  // namespace lightloom::test
