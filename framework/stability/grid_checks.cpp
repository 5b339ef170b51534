#include <cmath>
#include <string>

#include "framework/base/error.hpp"
#include "framework/run/device_room.hpp"
#include "framework/run/executor.hpp"
#include "framework/stability/check.hpp"
#include "framework/stability/differences.hpp"
#include "framework/stability/rooms.hpp"

namespace lightloom::stability {
namespace {

constexpr uint32_t kWidth = 32, kHeight = 24;
constexpr uint64_t kGibibyte = uint64_t{1} << 30;

RunOptions grid_run(uint32_t resolution, uint32_t paths) {
  RunOptions options = small_run(kWidth, kHeight, resolution);
  options.link.sets.emplace_back("paths", std::to_string(paths));
  return options;
}

/// The bytes that the plan says its values take over those that the device gave to them.
double memory_ratio(Lab& lab, const scene::Scene& scene, uint32_t resolution) {
  Plan plan = lab.plan(lab.shipped_graph("lightloom"), scene, grid_run(resolution, 1).link);
  const auto modelled = static_cast<double>(memory_use(plan.graph).total);
  run::ExecutorOptions options{.shaders = lab.shaders(), .camera = {}};
  options.share_memory = false;
  const run::Executor executor(lab.device(), std::move(plan), scene, options);
  return modelled / static_cast<double>(executor.value_bytes());
}

/// What is said of a grid of 512 voxels a side on a device with little memory; empty if nothing.
std::string refusal_of_large_grid(Lab& lab, const scene::Scene& scene) {
  const Plan plan = lab.plan(lab.shipped_graph("lightloom"), scene, grid_run(512, 1).link);
  run::DeviceRoom room = run::room_of(lab.device());
  room.bytes = kGibibyte;
  try {
    run::require_room(plan.graph, room);
  } catch (const Error& error) {
    return std::string(error.what()) + " / " + error.hint();
  }
  return {};
}

std::vector<Figure> measure_memory(Lab& lab) {
  const scene::Scene room = furnished_room();
  std::vector<Figure> figures;
  for (const uint32_t resolution : {8u, 32u, 128u, 256u})
    figures.push_back(at_most("modelled over allocated memory less 1, grid " + std::to_string(resolution),
                              std::abs(memory_ratio(lab, room, resolution) - 1), 0.01, "relative"));
  const std::string refusal = refusal_of_large_grid(lab, room);
  const auto says = [&](const char* text) { return refusal.find(text) != std::string::npos ? 1 : 0; };
  figures.push_back(equal("a grid of 512 where 1 GiB is left: refused with the bytes and what to lower",
                          says("(1073741824 bytes)") * says("'resolution'"), 1));
  return figures;
}

/// The same light by triangles, with many paths: what grids come closer to.
image::HostImage ground_truth(Lab& lab, const scene::Scene& scene) {
  RunOptions options = small_run(kWidth, kHeight, 8);
  options.link.variants.clear();
  options.link.sets = {{"paths", "512"}};
  return lab.last_frame(lab.shipped_graph("reference"), scene, options).at("radiance");
}

double root_mean_square_error(const image::HostImage& truth, const image::HostImage& picture) {
  const double peak = largest_value(truth);
  return peak * std::pow(10, -peak_signal_to_noise(truth, picture) / 20);
}

std::vector<Figure> measure_sizes(Lab& lab, const std::vector<uint32_t>& resolutions, uint32_t paths) {
  const scene::Scene room = furnished_room();
  const std::string graph = lab.shipped_graph("lightloom");
  const image::HostImage truth = ground_truth(lab, room);
  std::vector<Figure> figures;
  std::vector<double> errors;
  for (const uint32_t resolution : resolutions) {
    const image::HostImage picture = lab.last_frame(graph, room, grid_run(resolution, paths)).at("radiance");
    const std::string at = ", grid " + std::to_string(resolution);
    figures.push_back(none("pixels that are not finite" + at, non_finite_texels(picture)));
    errors.push_back(root_mean_square_error(truth, picture));
    if (errors.size() > 1)
      figures.push_back(
          at_most("root mean square error" + at + ", next coarser: " + std::to_string(errors[errors.size() - 2]),
                  errors.back(), errors[errors.size() - 2]));
  }
  return figures;
}

}  // namespace

void add_grid_checks(std::vector<Check>& checks) {
  checks.push_back({.name = "grid_memory",
                    .group = "grids",
                    .extreme = "grids of 8 to 512 voxels a side",
                    .danger = "gigabytes that nobody foresaw, then a crash",
                    .guard = "require_room before anything is allocated: framework/run/device_room.cpp",
                    .measure = measure_memory});
  checks.push_back({.name = "grid_sizes",
                    .group = "grids",
                    .extreme = "grids of 8 to 128 voxels a side",
                    .danger = "offsets that do not fit a coarse grid, steps that do not fit a fine one",
                    .guard = "all lengths in voxels: shaders/lib/grid.glsl, ray_start.glsl",
                    .measure = [](Lab& lab) {
                      return measure_sizes(lab, {8, 32, 128}, 64);
                    }});
  // Against 32, as from about 128 on the noise of the paths hides what the grid still does.
  checks.push_back({.name = "grid_512",
                    .group = "grids",
                    .extreme = "a grid of 512 voxels a side against one of 32",
                    .danger = "indices beyond 16 bits, volumes beyond the device's limits",
                    .guard = "32-bit indices; extents are held against the device's limits",
                    .measure =
                        [](Lab& lab) {
                          return measure_sizes(lab, {32, 512}, 64);
                        },
                    .slow = true});
}

}  // namespace lightloom::stability
