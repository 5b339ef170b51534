#include "tests/study/sample_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/image/png.hpp"

namespace lightloom::study {
namespace {

constexpr uint32_t kWidth = 160;
constexpr uint32_t kHeight = 120;

double noise(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 374761393U + y * 668265263U + seed * 2246822519U;
  h = (h ^ (h >> 13)) * 1274126177U;
  return static_cast<double>((h ^ (h >> 16)) & 0xFFFFFFU) / 0xFFFFFF - 0.5;
}

using Colour = std::array<double, 3>;

/// A sphere on a floor before a wall, in light from the left.
Colour scene_colour(uint32_t x, uint32_t y, double side) {
  const double u = (x + 0.5) / kWidth - 0.5 - side;
  const double v = (y + 0.5) / kHeight - 0.52;
  const double radius = 0.24;
  const double distance = std::hypot(u * kWidth / kHeight, v);
  if (distance < radius) {
    const double z = std::sqrt(radius * radius - distance * distance) / radius;
    const double light = std::max(0.06, -0.55 * u / radius - 0.5 * v / radius + 0.5 * z);
    return {0.9 * light, 0.55 * light, 0.25 * light};
  }
  if (v > 0.17) {
    const bool dark = (static_cast<int>(std::floor(u * 14 / v)) + static_cast<int>(std::floor(2.4 / v))) % 2 != 0;
    const double shade = std::hypot(u - 0.1, (v - 0.24) * 2.5) < 0.28 ? 0.35 : 1;
    return dark ? Colour{0.28 * shade, 0.3 * shade, 0.34 * shade} : Colour{0.7 * shade, 0.7 * shade, 0.66 * shade};
  }
  return {0.25 + 0.4 * (0.5 - u), 0.42 + 0.2 * (0.5 - u), 0.55};
}

image::HostImage blank() {
  image::HostImage picture;
  picture.desc.format = Format::rgba8_unorm;
  picture.desc.extent = {kWidth, kHeight, 1};
  picture.texels.resize(size_t{kWidth} * kHeight * 4);
  return picture;
}

void set(image::HostImage& picture, uint32_t x, uint32_t y, const Colour& colour) {
  for (size_t c = 0; c < 4; ++c) {
    const double value = c < 3 ? std::clamp(std::sqrt(std::max(0.0, colour.at(c))), 0.0, 1.0) : 1.0;
    picture.texels[(size_t{y} * kWidth + x) * 4 + c] = static_cast<std::byte>(std::lround(value * 255));
  }
}

void write_picture(const std::filesystem::path& file, double grain, double side, uint32_t seed) {
  image::HostImage picture = blank();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      Colour colour = scene_colour(x, y, side);
      const double n = 1 + grain * 2 * noise(x, y, seed);
      for (double& c : colour) c *= n;
      set(picture, x, y, colour);
    }
  }
  image::write_png(file, picture);
}

void write_heat_map(const std::filesystem::path& file, double grain, double side, uint32_t seed) {
  image::HostImage picture = blank();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const double error = std::abs(grain * 2 * noise(x, y, seed)) * scene_colour(x, y, side)[0];
      set(picture, x, y, {error, error * error, error * (1 - error) * 0.6});
    }
  }
  image::write_png(file, picture);
}

Estimate around(double mean, double half) {
  return {mean, mean - half, mean + half, half / 1.24, 5};
}

/// A setting of the sample: how noisy, and how many milliseconds its passes take of the usual ones.
struct Setting {
  std::string name;
  double grain = 0;
  double error = 0;
  std::vector<std::string> disabled;
  std::vector<std::string> culled;
};

const std::vector<Setting>& settings() {
  static const std::vector<Setting> kSettings = {
      {"paper", 0.10, 0.0712, {}, {}},
      {"without denoise_tangent", 0.22, 0.0893, {"denoise_tangent"}, {}},
      {"without denoise_bitangent", 0.2, 0.0868, {"denoise_bitangent"}, {}},
      {"without denoise_box_x", 0.12, 0.0719, {"denoise_box_x"}, {}},
      {"without denoise_box_y", 0.12, 0.0716, {"denoise_box_y"}, {}},
      {"without denoise_*",
       0.45,
       0.131,
       {"denoise_tangent", "denoise_bitangent", "denoise_box_x", "denoise_box_y"},
       {}},
      {"without temporal", 0.3, 0.1042, {"temporal"}, {}},
      {"without distance", 0.10, 0.0712, {"distance"}, {"voxelize_dynamic", "merge"}},
      {"paths=4", 0.06, 0.0581, {}, {}},
      {"paths=16", 0.02, 0.0447, {}, {}},
  };
  return kSettings;
}

struct UsualPass {
  std::string name;
  std::string type;
  double milliseconds = 0;
  bool hoisted = false;
};

const std::vector<UsualPass>& usual_passes() {
  static const std::vector<UsualPass> kPasses = {{"voxelize_static", "voxelize", 61.3, true},
                                                 {"voxelize_dynamic", "voxelize", 4.2, false},
                                                 {"merge", "voxel_merge", 1.1, false},
                                                 {"distance", "distance_transform", 6.4, false},
                                                 {"gather", "gather", 8.9, false},
                                                 {"trace_surface", "resample_surface", 1.4, false},
                                                 {"trace", "voxel_path_trace", 142.7, false},
                                                 {"temporal", "temporal_accumulate", 19.2, false},
                                                 {"denoise_tangent", "denoise_radial", 33.5, false},
                                                 {"denoise_bitangent", "denoise_radial", 31.9, false},
                                                 {"denoise_box_x", "box_blur", 7.3, false},
                                                 {"denoise_box_y", "box_blur", 7.1, false},
                                                 {"upsample", "upsample", 12.6, false},
                                                 {"modulate", "modulate", 3.3, false},
                                                 {"tonemap", "tonemap", 1.2, false}};
  return kPasses;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void add_times(Row& row, double paths) {
  for (const auto& pass : usual_passes()) {
    if (holds(row.disabled, pass.name) || holds(row.culled, pass.name)) continue;
    const double ms = pass.milliseconds * (pass.name == "trace" ? paths : 1);
    PassTiming timing{pass.name, {ms, ms * 1.08}, 0, pass.hoisted};
    if (pass.hoisted) timing = {pass.name, {}, ms, true};
    row.passes.push_back(timing);
    row.once_ms += timing.once;
    row.frame.median += timing.frame.median;
    row.frame.p95 += timing.frame.p95;
  }
  row.frame_ms = around(row.frame.median, row.frame.median * 0.012);
  row.wall = {row.frame.median * 1.1, row.frame.p95 * 1.2};
  row.first_frame_ms = row.frame.median * 2 + 310;
}

void add_metrics(Row& row, double error, double psnr) {
  row.metrics = {{"flip", around(error, 0.0008)},
                 {"relmse", around(error * error * 9, 0.0009)},
                 {"rmse", around(error * 0.8, 0.001)},
                 {"psnr", around(psnr, 0.12)},
                 {"ssim", around(1 - error * 1.4, 0.002)},
                 {"bias", around(0.002 - error * 0.01, 0.0011)},
                 {"fireflies", around(std::floor(error * 300), 3)}};
  row.bias_squared = around(error * error * 0.3, 0.0002);
  row.variance = around(error * error * 0.5, 0.0004);
}

void add_verdicts(Row& row, const Row& baseline) {
  const auto judge = [](const Estimate& a, const Estimate& b) {
    const double half = (a.high - a.low + b.high - b.low) / 3;
    const Estimate difference = around(a.mean - b.mean, half);
    return Verdict{difference, a.mean / b.mean, difference.low <= 0 && difference.high >= 0};
  };
  for (const auto& [name, value] : row.metrics) row.verdicts[name] = judge(value, baseline.metrics.at(name));
  row.verdicts["frame_ms"] = judge(row.frame_ms, baseline.frame_ms);
}

void add_graph(StudyResults& results) {
  for (const auto& pass : usual_passes()) results.graph_passes.push_back({pass.name, pass.type, pass.hoisted});
  results.graph_edges = {
      {"voxelize_static", "merge", "voxels → static", 0},  {"voxelize_dynamic", "merge", "voxels → dynamic", 0},
      {"merge", "merge", "voxels → previous", 1},          {"merge", "distance", "voxels → voxels", 0},
      {"gather", "trace_surface", "surface → surface", 0}, {"merge", "trace", "voxels → voxels", 0},
      {"distance", "trace", "distance → distance", 0},     {"trace_surface", "trace", "surface → surface", 0},
      {"trace", "temporal", "radiance → radiance", 0},     {"trace_surface", "temporal", "surface → surface", 0},
      {"modulate", "temporal", "radiance → previous", 1}};
  for (uint32_t age = 1; age <= 9; ++age) {
    results.graph_edges.push_back({"trace", "temporal", "radiance → trail", age});
    results.graph_edges.push_back({"trace_surface", "temporal", "surface.position → trail_position", age});
  }
  const std::vector<std::string> chain = {"temporal",      "denoise_tangent", "denoise_bitangent", "denoise_box_x",
                                          "denoise_box_y", "upsample",        "modulate",          "tonemap"};
  for (size_t i = 1; i < chain.size(); ++i) {
    results.graph_edges.push_back({chain[i - 1], chain[i], "radiance → radiance", 0});
    if (i <= 4) results.graph_edges.push_back({"trace_surface", chain[i], "surface → surface", 0});
  }
  results.graph_edges.push_back({"trace_surface", "upsample", "surface → trace_surface", 0});
  results.graph_edges.push_back({"gather", "upsample", "surface → surface", 0});
  results.graph_edges.push_back({"gather", "modulate", "surface → surface", 0});
}

void add_trades(StudyResults& results, const std::string& camera) {
  results.equal_time.push_back({"atrium", camera, "paper", 280, 280.8, 0.0712, "measured"});
  results.equal_time.push_back({"atrium", camera, "raw, paths", 280, 280, 0.0934, "between paths=1 and paths=4"});
  results.equal_error.push_back({"atrium", camera, "paper", 0.0712, 280.8, 0.0712, "measured"});
  results.equal_error.push_back({"atrium", camera, "raw, paths", 0.0712, 611, 0.0712, "between paths=4 and paths=16"});
}

Row make_row(const Setting& setting, const std::string& camera) {
  Row row;
  row.setting = setting.name;
  row.scene = "atrium";
  row.camera = camera;
  row.disabled = setting.disabled;
  row.culled = setting.culled;
  const double paths = setting.name == "paths=4" ? 4 : setting.name == "paths=16" ? 16 : 1;
  row.values = {{"paths", std::to_string(static_cast<int>(paths))}};
  row.command = {"lightloom",
                 "render",
                 "graphs/paper.json",
                 "--scene",
                 "samples/scenes/atrium.gltf",
                 "--camera",
                 camera,
                 "--size",
                 "320x240",
                 "--seed",
                 "1"};
  for (const auto& name : row.disabled) row.command.insert(row.command.end(), {"--disable", name});
  row.memory_bytes = 41'000'000 - 3'000'000 * (row.disabled.size() + row.culled.size());
  add_times(row, paths);
  return row;
}

}  // namespace

StudyResults sample_results(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "pictures");
  StudyResults results;
  results.name = "What each denoiser stage buys";
  results.description = "The paper's pipeline with each stage of its denoiser off in turn, and more paths instead.";
  results.graph = "graphs/paper.json";
  results.metric = "flip";
  results.axes = {"paths"};
  results.provenance = {{"device", "llvmpipe (LLVM 15.0.6, 256 bits)"},
                        {"commit", "0123456789ab"},
                        {"seeds", "1, 2, 3, 4, 5"},
                        {"frames", "16, the first 4 not timed"},
                        {"size", "320x240, traced at 160x120"}};
  results.notes = {"Sample figures: they were made up to test this page."};
  add_graph(results);
  for (const std::string camera : {"front", "gallery"}) {
    const double side = camera == "front" ? 0.0 : 0.18;
    const std::string reference = "pictures/" + camera + "_reference.png";
    write_picture(folder / reference, 0, side, 0);
    results.views.push_back({"atrium", camera, reference, 2.1e-4, "reference_path_trace, triangles, 1024 paths"});
    const size_t baseline = results.rows.size();
    uint32_t index = 0;
    for (const Setting& setting : settings()) {
      Row row = make_row(setting, camera);
      const bool equal = setting.name == "paths=16" && camera == "gallery";
      const double error = equal ? 0.0 : setting.error * (camera == "front" ? 1 : 1.13);
      add_metrics(row, error, equal ? std::numeric_limits<double>::infinity() : 30 - 60 * error);
      if (equal)
        row.metrics["psnr"] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::quiet_NaN(), 0, 5};
      if (index > 0) add_verdicts(row, results.rows[baseline]);
      row.pareto = setting.name != "without distance" && setting.error < 0.075;
      row.picture = "pictures/" + camera + "_" + std::to_string(index) + ".png";
      row.heat_map = "pictures/" + camera + "_" + std::to_string(index) + "_flip.png";
      write_picture(folder / row.picture, setting.grain, side, index + 1);
      write_heat_map(folder / row.heat_map, setting.grain, side, index + 1);
      results.rows.push_back(std::move(row));
      ++index;
    }
    Row failed;
    failed.setting = "without trace";
    failed.scene = "atrium";
    failed.camera = camera;
    failed.disabled = {"trace"};
    failed.command = {"lightloom", "render", "graphs/paper.json", "--disable", "trace"};
    failed.error = "'trace' cannot be disabled: 'temporal.radiance' reads its output 'radiance', which has no bypass";
    results.rows.push_back(failed);
    add_trades(results, camera);
  }
  return results;
}

StudyResults many_rows(const std::filesystem::path& folder, size_t count) {
  StudyResults results = sample_results(folder);
  const Row first = results.rows.front();
  results.views.resize(1);
  results.rows.clear();
  for (size_t i = 0; i < count; ++i) {
    Row row = first;
    row.setting = "resolution=" + std::to_string(32 + i) + " radius=" + std::to_string(i % 7);
    for (auto& [name, value] : row.metrics) value = around(value.mean * (1 + 0.01 * static_cast<double>(i)), 0.001);
    row.frame_ms = around(280 / (1 + 0.02 * static_cast<double>(i)), 2);
    if (i > 0) add_verdicts(row, results.rows.front());
    results.rows.push_back(row);
  }
  return results;
}

StudyResults hostile_results(const std::filesystem::path& folder) {
  StudyResults results = sample_results(folder);
  const std::string odd =
      "</script><script>window.broken=1</script><!-- \"quoted\" 'single' & \xE2\x80\xA8 \\u003c {{data}} ";
  results.name = odd;
  results.description = odd + std::string(300, 'x');
  results.notes = {odd};
  results.provenance = {{odd, odd}};
  for (Row& row : results.rows) row.setting += odd;
  results.rows[1].setting = std::string(220, 'w');
  results.rows[2].command.push_back("it's $(odd) \"");
  results.graph_passes[3].name = odd;
  results.graph_passes[4].type = std::string(90, 't');
  for (View& view : results.views) view.scene = odd;
  for (Row& row : results.rows) row.scene = odd;
  return results;
}

}  // namespace lightloom::study
