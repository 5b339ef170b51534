// What the probe says of a pixel, against the dumps of a render and against closed forms.
#include "framework/run/probe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/image/npy.hpp"
#include "framework/run/probe_places.hpp"
#include "passes/registry.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using ::testing::HasSubstr;

class ProbeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    passes::register_builtin_passes(registry_);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::temp_directory_path() / ("lightloom-probe-" + std::to_string(getpid()) + "-" + std::string(test->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Camera and gem move; the first frame is not 0, and the view no multiple of what is traced.
  RenderRequest paper_request() const {
    RenderRequest made;
    made.graph = source_dir() / "graphs/paper.json";
    made.scene = source_dir() / "samples/scenes/atrium.scene.json";
    made.camera_path = source_dir() / "samples/scenes/atrium.path.json";
    made.link.view = {37, 26};
    made.link.trace = {16, 12};
    made.link.sets = {{"resolution", "20"}};
    made.first_frame = 4;
    made.last_frame = 6;
    made.dump_format = DumpFormat::npy;
    made.out = folder_ / "run";
    return made;
  }

  ordered_json render_run(const RenderRequest& wanted) {
    Diagnostics diagnostics;
    RenderSummary summary;
    EXPECT_TRUE(render(wanted, registry_, {}, diagnostics, summary));
    return ordered_json::parse(read_text_file(wanted.out / "run.json"));
  }

  ProbeReport probe_pixel(const ProbeRequest& wanted) {
    Diagnostics diagnostics;
    ProbeReport report;
    EXPECT_TRUE(probe(wanted, registry_, {}, diagnostics, report));
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    for (const std::string& warning : report.warnings) ADD_FAILURE() << warning;
    return report;
  }

  PassRegistry registry_;
  fs::path folder_;
};

/// The texel of a dump at the probed place, or zeros for a frame before the first.
std::vector<std::byte> dumped_texel(const fs::path& run, const ProbedTexel& probed, uint32_t frame, uint32_t first) {
  const uint32_t bytes = format_info(probed.desc.format).bytes_per_texel;
  if (frame < first + probed.age) return std::vector<std::byte>(bytes);
  const std::string number = std::to_string(frame - probed.age);
  const auto image =
      image::read_npy(run / "dumps" / (std::string(4 - number.size(), '0') + number) / (probed.value + ".npy"));
  const Extent3& extent = image.desc.extent;
  const size_t texel = (size_t{probed.place[2]} * extent.height + probed.place[1]) * extent.width + probed.place[0];
  return {image.texels.begin() + static_cast<std::ptrdiff_t>(texel * bytes),
          image.texels.begin() + static_cast<std::ptrdiff_t>((texel + 1) * bytes)};
}

/// docs/buffers.md: does the voxel hold the point?
void expect_voxel_holds(const ProbedTexel& probed, const ordered_json& bounds, const glm::vec3& point) {
  const Extent3& extent = probed.desc.extent;
  const double sizes[3] = {double(extent.width), double(extent.height), double(extent.depth)};
  const double longest_axis = std::max({sizes[0], sizes[1], sizes[2]});
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, bounds["max"][axis].get<double>() - bounds["min"][axis].get<double>());
  const double edge = longest / (longest_axis - 2);
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = (bounds["max"][axis].get<double>() + bounds["min"][axis].get<double>()) / 2;
    const double low = middle - edge * sizes[axis] / 2 + edge * probed.place[static_cast<size_t>(axis)];
    EXPECT_GE(point[axis], low - 1e-5 * longest) << probed.value;
    EXPECT_LE(point[axis], low + edge + 1e-5 * longest) << probed.value;
  }
}

TEST_F(ProbeTest, EveryTexelIsThatOfTheDump) {
  RenderRequest dumped = paper_request();
  dumped.link.captures = {"*"};
  const ordered_json record = render_run(dumped);
  RenderRequest plain = paper_request();
  plain.out = folder_ / "plain";
  const ordered_json plain_record = render_run(plain);
  size_t texels = 0;
  size_t volumes = 0;
  for (const auto& [x, y] : {std::pair{0U, 0U}, {36U, 25U}, {18U, 17U}}) {
    ProbeRequest wanted{.render = paper_request(), .x = x, .y = y, .every = true};
    wanted.render.device.validate = x == 18;
    const ProbeReport report = probe_pixel(wanted);
    ASSERT_EQ(report.frames.size(), 3U);
    for (const ProbedFrame& frame : report.frames) {
      const auto conditions =
          ordered_json::parse(read_text_file(dumped.out / "dumps" / frame_text(frame.frame) / "frame.json"));
      EXPECT_EQ(frame.history_length, conditions["history_length"]);
      EXPECT_EQ(frame.time, conditions["time"]);
      ASSERT_TRUE(frame.point) << "the atrium has walls all around";
      std::vector<std::string> ran;
      for (const ProbedPass& pass : frame.passes) {
        ran.push_back(pass.name);
        for (const auto* list : {&pass.inputs, &pass.outputs, &pass.scratch}) {
          for (const ProbedTexel& probed : *list) {
            if (!probed.texel) continue;
            EXPECT_EQ(probed.texel->texels, dumped_texel(dumped.out, probed, frame.frame, 4))
                << probed.value << "@" << probed.age << " in frame " << frame.frame;
            ++texels;
            if (probed.desc.dimension == Dimension::d3) {
              ++volumes;
              expect_voxel_holds(probed, conditions["scene_bounds"], *frame.point);
              continue;
            }
            const double column = (x + 0.5) * probed.desc.extent.width / 37;
            EXPECT_EQ(probed.place[0], uint32_t(std::floor(column)));
            EXPECT_EQ(probed.place[1], uint32_t(std::floor((y + 0.5) * probed.desc.extent.height / 26)));
          }
        }
      }
      std::vector<std::string> expected;
      for (const char* list : {"hoisted", "passes"})
        for (const ordered_json& pass : plain_record[list]) expected.push_back(pass["pass"]);
      EXPECT_EQ(ran, expected) << "those of a render, in its order";
    }
  }
  EXPECT_GT(texels, 1000U);
  EXPECT_GT(volumes, 100U);
}

TEST_F(ProbeTest, TheLastFrameAloneIsTheSame) {
  ProbeRequest wanted{.render = paper_request(), .x = 20, .y = 11, .every = true};
  const ProbeReport every = probe_pixel(wanted);
  wanted.every = false;
  wanted.render.share_memory = false;
  const ProbeReport last = probe_pixel(wanted);
  ASSERT_EQ(last.frames.size(), 1U);
  const ProbedFrame& one = last.frames[0];
  const ProbedFrame& other = every.frames.back();
  EXPECT_EQ(one.frame, other.frame);
  ASSERT_EQ(one.passes.size(), other.passes.size());
  for (size_t pass = 0; pass < one.passes.size(); ++pass) {
    ASSERT_EQ(one.passes[pass].outputs.size(), other.passes[pass].outputs.size());
    for (size_t i = 0; i < one.passes[pass].outputs.size(); ++i) {
      const auto &a = one.passes[pass].outputs[i].texel, &b = other.passes[pass].outputs[i].texel;
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_EQ(a->texels, b->texels) << one.passes[pass].outputs[i].value;
      }
    }
  }
}

TEST_F(ProbeTest, AToyGraphByItsClosedForm) {
  // ramp is 1 + x; count adds one to what it was a frame ago at the same place.
  PassType counter = toy::one_shader_type(
      "test_counter", {toy::image_port("previous", Direction::in), toy::image_port("count", Direction::out)},
      "test_counter.comp", "count");
  counter.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
  registry_.add(toy::one_shader_type("test_ramp", {toy::image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp"));
  registry_.add(counter);
  std::ofstream(folder_ / "toy.json") << R"({ "lightloom": 1, "name": "toy",
    "view": { "width": 40, "height": 30 }, "trace": { "width": 20, "height": 9 },
    "passes": {
      "ramp": { "type": "test_ramp" },
      "next": { "type": "test_counter", "in": { "previous": "ramp.ramp" }, "params": { "start": 10 } },
      "own": { "type": "test_counter", "in": { "previous": "own.count@1" } },
      "old": { "type": "test_counter", "in": { "previous": "own.count@3" } },
      "unused": { "type": "test_ramp" }
    },
    "outputs": { "next": "next.count", "old": "old.count" } })";
  ProbeRequest wanted;
  wanted.render = paper_request();
  wanted.render.graph = folder_ / "toy.json";
  wanted.render.link = {};
  wanted.render.camera_path.clear();
  wanted.render.first_frame = 0;
  wanted.render.last_frame = 5;
  wanted.render.shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  wanted.render.device.validate = true;
  wanted.x = 31;
  wanted.y = 7;
  wanted.every = true;
  const ProbeReport report = probe_pixel(wanted);
  ASSERT_EQ(report.culled.size(), 1U);
  EXPECT_EQ(report.culled[0].pass, "unused");
  const auto number = [](const ProbedTexel& probed) { return probed.texel->at(0, 0, 0, 0); };
  for (uint32_t frame = 0; frame < 6; ++frame) {
    const ProbedFrame& at = report.frames.at(frame);
    EXPECT_FALSE(at.point);
    EXPECT_THAT(at.point_source, HasSubstr("no value of the graph"));
    for (const ProbedPass& pass : at.passes) {
      for (const ProbedTexel& output : pass.outputs) {
        EXPECT_EQ(output.place, (std::array<uint32_t, 3>{15, 2, 0}));
        EXPECT_EQ(output.desc.extent.width, 20U);
        const double own = frame + 1.0;
        const double expected = pass.name == "ramp"   ? 16
                                : pass.name == "next" ? 27
                                : pass.name == "own"  ? own
                                                      : std::max(own - 3, 0.0) + 1;
        EXPECT_EQ(number(output), expected) << pass.name << " in frame " << frame;
        for (const ProbedTexel& input : pass.inputs) {
          EXPECT_EQ(number(input), expected - (pass.name == "next" ? 11 : 1)) << pass.name << " in frame " << frame;
          EXPECT_EQ(input.age, pass.name == "own" ? 1U : pass.name == "old" ? 3U : 0U);
        }
      }
    }
    EXPECT_EQ(at.passes.size(), 4U);
  }
}

TEST_F(ProbeTest, APixelOutsideTheViewIsRefused) {
  for (const auto& [x, y] : {std::pair{37U, 0U}, {0U, 26U}, {4000000000U, 1U}}) {
    Diagnostics diagnostics;
    ProbeReport report;
    try {
      static_cast<void>(probe({.render = paper_request(), .x = x, .y = y}, registry_, {}, diagnostics, report));
      ADD_FAILURE() << x << "," << y;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_THAT(error.what(), HasSubstr("outside the view of 37x26 pixels"));
      EXPECT_THAT(error.hint(), HasSubstr("36,25"));
    }
  }
}

TEST(ProbePlaces, ATexelCoversThePixelsCentre) {
  for (const uint32_t size : {1U, 3U, 16U, 37U, 100U, 16384U}) {
    for (uint32_t x = 0; x < 37; ++x) {
      const uint32_t texel = texel_at({size, 5, 1}, {37, 26, 1}, x, 0)[0];
      EXPECT_LE(uint64_t{texel} * 2 * 37, (uint64_t{x} * 2 + 1) * size);
      EXPECT_GT(uint64_t{texel + 1} * 2 * 37, (uint64_t{x} * 2 + 1) * size);
    }
  }
}

TEST(ProbePlaces, PointsThatNoVoxelHolds) {
  const scene::Bounds bounds{glm::vec3(0), glm::vec3(4, 2, 1)};
  const Extent3 grid{10, 6, 4};  // voxels of half a metre: one of padding at each end
  EXPECT_EQ(voxel_at(grid, bounds, {0.1f, 0.6f, 0.9f}).texel, (std::array<uint32_t, 3>{1, 2, 2}));
  EXPECT_EQ(voxel_at(grid, bounds, {0.1f, 0.6f, 0.9f}).missing, "");
  EXPECT_THAT(voxel_at(grid, bounds, {-0.6f, 0, 0}).missing, HasSubstr("outside"));
  EXPECT_THAT(voxel_at(grid, bounds, {0, 2.6f, 0}).missing, HasSubstr("outside"));
  EXPECT_THAT(voxel_at(grid, bounds, {0, NAN, 0}).missing, HasSubstr("outside"));
  EXPECT_THAT(voxel_at({10, 10, 10}, bounds, {0, 0, 0}).missing, HasSubstr("no voxel grid"));
}

}  // namespace
}  // namespace lightloom::run
