// The main job end to end: the paper's graph on the sample scene, small, with validation on.
#include "framework/run/render.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/npy.hpp"
#include "framework/image/png.hpp"
#include "framework/run/compile_graph.hpp"
#include "passes/registry.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kWidth = 128;
constexpr uint32_t kHeight = 96;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

/// Whether two runs wrote the same file. (EXPECT_EQ on the bytes would print them.)
bool same_file(const fs::path& one, const fs::path& other) {
  return bytes_of(one) == bytes_of(other);
}

class Render : public ::testing::Test {
 protected:
  void SetUp() override {
    passes::register_builtin_passes(registry_);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("lightloom-render-" + std::string(test->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    nlohmann::ordered_json graph = nlohmann::ordered_json::parse(read_text_file(source("graphs/paper.json")));
    graph["view"] = {{"width", kWidth}, {"height", kHeight}};
    graph["trace"] = {{"width", kWidth}, {"height", kHeight}};
    graph["params"]["resolution"] = 96;
    std::ofstream(folder_ / "small.json") << graph.dump(1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static fs::path source(const char* relative) { return source_dir() / relative; }

  RenderRequest request(const std::string& out, uint32_t last_frame) const {
    RenderRequest made;
    made.graph = folder_ / "small.json";
    made.scene = source("samples/scenes/atrium.scene.json");
    made.last_frame = last_frame;
    made.out = folder_ / out;
    made.device.validate = true;
    return made;
  }

  /// Renders, and demands that neither the graph nor the validation layers complain.
  RenderSummary render_cleanly(const RenderRequest& wanted) {
    Diagnostics diagnostics;
    RenderSummary summary;
    const bool done = render(wanted, registry_, {}, diagnostics, summary);
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    for (const std::string& warning : summary.warnings) ADD_FAILURE() << warning;
    EXPECT_TRUE(done);
    return summary;
  }

  PassRegistry registry_;
  fs::path folder_;
};

/// Mean of a channel over a rectangle given in fractions of the image.
double mean(const image::ExrImage& image, const char* channel, double x0, double y0, double x1, double y1) {
  double sum = 0;
  int count = 0;
  for (auto y = static_cast<uint32_t>(y0 * image.height); y < static_cast<uint32_t>(y1 * image.height); ++y)
    for (auto x = static_cast<uint32_t>(x0 * image.width); x < static_cast<uint32_t>(x1 * image.width); ++x, ++count)
      sum += image.at(x, y, channel);
  return sum / count;
}

/// Noise of what the filters made: mean absolute difference of horizontal and vertical neighbours on the right wall,
/// which is flat and evenly lit, relative to the mean there.
double noise(const image::ExrImage& image) {
  double difference = 0;
  double sum = 0;
  for (uint32_t y = image.height * 4 / 10; y < image.height * 7 / 10; ++y)
    for (uint32_t x = image.width * 94 / 100; x + 1 < image.width; ++x) {
      difference += std::abs(image.at(x, y, "G") - image.at(x + 1, y, "G"));
      difference += std::abs(image.at(x, y, "G") - image.at(x, y + 1, "G"));
      sum += image.at(x, y, "G");
    }
  return difference / sum;
}

TEST_F(Render, ThePictureShowsTheAtrium) {
  render_cleanly(request("run", 9));
  const image::ExrImage radiance = image::read_exr(folder_ / "run/radiance.0009.exr");
  ASSERT_EQ(radiance.width, kWidth);
  ASSERT_EQ(radiance.height, kHeight);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      for (const char* channel : {"R", "G", "B"}) {
        const double value = radiance.at(x, y, channel);
        ASSERT_TRUE(std::isfinite(value) && value >= 0) << channel << " at " << x << "," << y << " is " << value;
      }
  // Places of the scene in camera "nave": the red wall behind the left colonnade, the blue one on the right, the panel
  // on the back wall, the sunlit white arcade and the shaded wooden beams.
  const double red_wall = mean(radiance, "R", 0.15, 0.35, 0.20, 0.5);
  EXPECT_GT(red_wall, 2 * mean(radiance, "B", 0.15, 0.35, 0.20, 0.5));
  EXPECT_GT(mean(radiance, "B", 0.93, 0.45, 1.0, 0.7), 1.5 * mean(radiance, "R", 0.93, 0.45, 1.0, 0.7));
  EXPECT_GT(mean(radiance, "G", 0.625, 0.44, 0.64, 0.52), 5) << "the emissive panel";
  EXPECT_GT(mean(radiance, "G", 0.06, 0.4, 0.10, 0.7), 2 * mean(radiance, "G", 0.45, 0.08, 0.6, 0.1))
      << "a sunlit column against the beams under the roof";
  EXPECT_GT(mean(radiance, "G", 0.4, 0.2, 0.65, 0.55), 0.01) << "indirect light must reach the back wall";
}

TEST_F(Render, WatchingEveryValueChangesNoBit) {
  RenderRequest watched = request("watched", 2);
  watched.link.captures = {"*"};
  render_cleanly(request("plain", 2));
  render_cleanly(watched);
  for (const char* file : {"image.0000.png", "image.0002.png", "radiance.0000.exr", "radiance.0002.exr"})
    EXPECT_TRUE(same_file(folder_ / "plain" / file, folder_ / "watched" / file)) << file;
}

TEST_F(Render, EveryValueOfEveryPassIsDumped) {
  RenderRequest watched = request("watched", 0);
  watched.link.captures = {"*"};
  render_cleanly(watched);
  const scene::Scene scene = scene::load_scene(watched.scene);
  Diagnostics diagnostics;
  const std::optional<Plan> plan = compile_graph(watched.graph, registry_, watched.link, &scene, diagnostics);
  ASSERT_TRUE(plan);
  size_t expected = 0;
  for (const Value& value : plan->graph.values) {
    if (value.constant) continue;
    ++expected;
    const std::string extension = value.desc.dimension == Dimension::d3 ? ".npy" : ".exr";
    EXPECT_TRUE(fs::is_regular_file(folder_ / "watched/dumps/0000" / (value_name(value) + extension)))
        << value_name(value);
  }
  EXPECT_GT(expected, 30u);
  const nlohmann::json index = nlohmann::json::parse(read_text_file(folder_ / "watched/dumps/index.json"));
  EXPECT_EQ(index["values"].size(), expected);
  EXPECT_EQ(index["frames"][0]["files"].size(), expected);
  for (const auto& [name, value] : index["values"].items())
    EXPECT_FALSE(value["doc"].get<std::string>().empty()) << name;
}

TEST_F(Render, DumpsHoldTheSameNumbersInBothFormats) {
  RenderRequest exr = request("exr", 0);
  exr.link.captures = {"gather.surface", "trace.radiance"};
  RenderRequest npy = exr;
  npy.out = folder_ / "npy";
  npy.dump_format = DumpFormat::npy;
  render_cleanly(exr);
  render_cleanly(npy);
  const std::map<std::string, std::vector<std::string>> values = {{"gather.surface.position", {"X", "Y", "Z", "W"}},
                                                                  {"gather.surface.material", {"R", "G", "B", "A"}},
                                                                  {"trace.radiance", {"R", "G", "B", "A"}}};
  for (const auto& [name, channels] : values) {
    const image::ExrImage one = image::read_exr(folder_ / "exr/dumps/0000" / (name + ".exr"));
    const image::HostImage other = image::read_npy(folder_ / "npy/dumps/0000" / (name + ".npy"));
    for (uint32_t channel = 0; channel < channels.size(); ++channel)
      for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
          ASSERT_EQ(one.at(x, y, channels[channel]), other.at(x, y, 0, channel)) << name << " " << channels[channel];
  }
}

/// A pinhole's own arithmetic: distances along and across the line of sight over the tangent of half the field of view.
glm::dvec2 project(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov, const glm::dvec3& point) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dvec3 away = point - eye;
  const double scale = kHeight / (2 * glm::dot(away, forward) * std::tan(vertical_fov / 2));
  return {kWidth * 0.5 + glm::dot(away, right) * scale, kHeight * 0.5 - glm::dot(away, up) * scale};
}

TEST_F(Render, TheCameraFollowsItsPathAndFramesRecordIt) {
  std::ofstream(folder_ / "path.json") << R"({"lightloom_camera_path": 1, "interpolation": "linear", "keyframes": [
    {"time": 0, "position": [-5, 2, 0], "target": [5, 2, 0], "vertical_fov_degrees": 60},
    {"time": 0.1, "position": [-4, 2.5, 0.5], "target": [5, 1, 1], "vertical_fov_degrees": 40}]})";
  RenderRequest moving = request("moving", 2);
  moving.camera_path = folder_ / "path.json";
  moving.dump_format = DumpFormat::npy;
  moving.link.captures = {"gather.surface.position"};
  render_cleanly(moving);
  const nlohmann::json record = nlohmann::json::parse(read_text_file(folder_ / "moving/run.json"));
  EXPECT_EQ(record["camera_path"]["keyframes"].size(), 2u);
  for (uint32_t frame = 0; frame <= 2; ++frame) {
    const double amount = frame / 3.0;  // 30 frames a second, 0.1 s
    const glm::dvec3 eye(-5 + amount, 2 + 0.5 * amount, 0.5 * amount);
    const glm::dvec3 target(5, 2 - amount, amount);
    const double fov = glm::radians(60 - 20 * amount);
    const fs::path dumps = folder_ / "moving/dumps" / frame_text(frame);
    const nlohmann::json conditions = nlohmann::json::parse(read_text_file(dumps / "frame.json"));
    EXPECT_NEAR(conditions["time"], frame / 30.0, 1e-12);
    EXPECT_EQ(conditions["history_length"], frame);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(conditions["eye"][axis], eye[axis], 1e-5);
    const image::HostImage position = image::read_npy(dumps / "gather.surface.position.npy");
    for (uint32_t y = 0; y < kHeight; y += 5)
      for (uint32_t x = 0; x < kWidth; x += 5) {
        if (position.at(x, y, 0, 3) <= 0) continue;
        const glm::dvec4 point(position.at(x, y, 0, 0), position.at(x, y, 0, 1), position.at(x, y, 0, 2), 1);
        const glm::dvec2 seen = project(eye, target, fov, glm::dvec3(point));
        EXPECT_NEAR(seen.x, x + 0.5, 0.01);
        EXPECT_NEAR(seen.y, y + 0.5, 0.01);
        glm::dvec4 clip(0);
        for (int row = 0; row < 4; ++row)
          for (int column = 0; column < 4; ++column)
            clip[row] += conditions["view_projection"][row][column].get<double>() * point[column];
        EXPECT_NEAR((clip.x / clip.w * 0.5 + 0.5) * kWidth, x + 0.5, 0.01);
        EXPECT_NEAR((clip.y / clip.w * 0.5 + 0.5) * kHeight, y + 0.5, 0.01);
      }
  }
}

TEST_F(Render, TheSameRequestGivesTheSameBits) {
  render_cleanly(request("first", 2));
  render_cleanly(request("second", 2));
  for (const char* file : {"image.0002.png", "radiance.0002.exr"})
    EXPECT_TRUE(same_file(folder_ / "first" / file, folder_ / "second" / file)) << file;
}

TEST_F(Render, TheSeedChangesTheNoiseButNotThePicture) {
  RenderRequest one_seed = request("one", 0);
  RenderRequest other = request("other", 0);
  other.seed = 99;
  one_seed.link.sets = other.link.sets = {{"paths", "16"}};
  render_cleanly(one_seed);
  render_cleanly(other);
  EXPECT_FALSE(same_file(folder_ / "one/radiance.0000.exr", folder_ / "other/radiance.0000.exr"));
  const double one = mean(image::read_exr(folder_ / "one/radiance.0000.exr"), "G", 0, 0, 1, 1);
  const double two = mean(image::read_exr(folder_ / "other/radiance.0000.exr"), "G", 0, 0, 1, 1);
  EXPECT_NEAR(one / two, 1, 0.05);
}

TEST_F(Render, EachDenoiserPassSmoothesAndKeepsTheBrightness) {
  const auto filtered = [&](const std::string& name, const std::string& disabled) {
    RenderRequest wanted = request(name, 3);
    if (!disabled.empty()) wanted.link.disables = {disabled};
    wanted.link.captures = {"upsample.radiance"};
    render_cleanly(wanted);
    return image::read_exr(folder_ / name / "dumps/0003/upsample.radiance.exr");
  };
  const image::ExrImage without = filtered("none", "denoise_*");
  const image::ExrImage with = filtered("all", "");
  EXPECT_LT(noise(with), 0.5 * noise(without));
  EXPECT_NEAR(mean(with, "G", 0, 0, 1, 1) / mean(without, "G", 0, 0, 1, 1), 1, 0.05);
  for (const char* pass : {"denoise_tangent", "denoise_bitangent", "denoise_box_x", "denoise_box_y"}) {
    const image::ExrImage image = filtered(pass, pass);
    EXPECT_GT(noise(image), noise(with)) << pass;
    EXPECT_LT(noise(image), noise(without)) << pass;
  }
}

TEST_F(Render, TheAnimatedGemMoves) {
  RenderRequest earlier = request("earlier", 0);
  RenderRequest later = request("later", 30);
  later.first_frame = 30;
  earlier.link.captures = later.link.captures = {"gather.surface.id"};
  render_cleanly(earlier);
  render_cleanly(later);
  const image::ExrImage before = image::read_exr(folder_ / "earlier/dumps/0000/gather.surface.id.exr");
  const image::ExrImage after = image::read_exr(folder_ / "later/dumps/0030/gather.surface.id.exr");
  int changed = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) changed += before.at(x, y, "object") != after.at(x, y, "object") ? 1 : 0;
  EXPECT_GT(changed, 5);
  EXPECT_LT(changed, static_cast<int>(kWidth * kHeight / 10)) << "only the gem moves";
}

TEST_F(Render, AGraphThatDoesNotLinkLeavesNothingBehind) {
  RenderRequest impossible = request("impossible", 0);
  impossible.link.disables = {"gather", "tonemap"};
  Diagnostics diagnostics;
  RenderSummary summary;
  EXPECT_FALSE(render(impossible, registry_, {}, diagnostics, summary));
  EXPECT_TRUE(diagnostics.has_errors());
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) text += format_diagnostic(diagnostic) + "\n";
  EXPECT_NE(text.find("pass 'gather' is off"), std::string::npos) << text;
  EXPECT_NE(text.find("pass 'tonemap' is off"), std::string::npos) << "both in one go:\n" << text;
  EXPECT_FALSE(fs::exists(folder_ / "impossible"));
}

TEST_F(Render, AnUnknownCameraLeavesNothingBehind) {
  RenderRequest wrong = request("wrong", 0);
  wrong.camera = "crane";
  Diagnostics diagnostics;
  RenderSummary summary;
  EXPECT_THROW(render(wrong, registry_, {}, diagnostics, summary), Error);
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
}

TEST_F(Render, TheRecordTellsWhatWasRun) {
  RenderRequest recorded = request("run", 1);
  recorded.seed = 5;
  recorded.link.sets = {{"bounces", "1"}};
  render_cleanly(recorded);
  const nlohmann::json record = nlohmann::json::parse(read_text_file(folder_ / "run/run.json"));
  EXPECT_EQ(record["seed"], 5);
  EXPECT_EQ(record["graph"]["params"]["bounces"], 1);
  EXPECT_EQ(record["camera"], "nave");
  EXPECT_EQ(record["graph"]["plan_hash"].get<std::string>().size(), 16u);
  EXPECT_FALSE(record["device"]["name"].get<std::string>().empty());
  bool traced = false;
  for (const nlohmann::json& pass : record["passes"]) {
    traced = traced || pass["pass"] == "trace";
    EXPECT_EQ(pass["frames_ms"].size(), 2u) << pass["pass"];
  }
  EXPECT_TRUE(traced);
  ASSERT_EQ(record["hoisted"].size(), 1u);
  EXPECT_EQ(record["hoisted"][0]["pass"], "voxelize_static");
  EXPECT_EQ(record["hoisted"][0]["params"]["resolution"], 96);
  EXPECT_NE(record["hoisted"][0]["reason"].get<std::string>().find("static geometry"), std::string::npos);
  for (const nlohmann::json& file : record["files"])
    EXPECT_TRUE(fs::is_regular_file(folder_ / "run" / file.get<std::string>())) << file;
}

}  // namespace
}  // namespace lightloom::run
