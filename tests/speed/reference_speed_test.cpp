// How fast the reference tracer is. Labelled slow: a machine that is busy with other things fails it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "tests/support/source_dir.hpp"
#include "tests/support/tracing.hpp"

namespace lightloom::test {
namespace {

/// Camera paths a second of processor time, of those that meet the scene: up to five vertices each, next event
/// estimation at all of them.
double paths_per_second(const scene::Scene& scene) {
  reference::ImageSettings settings;
  settings.width = settings.height = 128;
  settings.paths = 64;
  settings.threads = 1;
  settings.path.bounces = 3;
  double best = 0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::clock_t begin = std::clock();
    const Traced traced = trace(scene, settings);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    double covered = 0;
    for (const reference::TracedPixel& pixel : traced.pixels) covered += static_cast<double>(pixel.covered);
    best = std::max(best, covered * settings.paths / seconds);
  }
  return best;
}

TEST(ReferenceSpeed, AMillionPathsASecondOnTwoCores) {
  const std::filesystem::path file = source_dir() / "../shared/scenes/cornell_box_original_emissive/scene.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const double speed = paths_per_second(scene::load_scene(file));
  std::printf("%.2f million camera paths a second on one core\n", speed * 1e-6);
  EXPECT_GT(speed, 0.5e6);
}

}  // namespace
}  // namespace lightloom::test
