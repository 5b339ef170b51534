// The graphs that ship, watched for NaN and poisoned: nothing is found, and the pictures are those of a plain render.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "framework/run/render.hpp"
#include "passes/registry.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kWidth = 48;
constexpr uint32_t kHeight = 36;

struct Shipped {
  const char* graph;
  bool still;  ///< nothing moves, so that more is hoisted
};

std::string test_name(const ::testing::TestParamInfo<Shipped>& info) {
  return std::string(info.param.graph) + (info.param.still ? "_still" : "_moving");
}

class ShippedChecks : public ::testing::TestWithParam<Shipped> {
 protected:
  ShippedChecks() {
    passes::register_builtin_passes(registry_);
    std::string name = (fs::temp_directory_path() / "lightloom_checks_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    const std::string file = std::string(GetParam().graph) + ".json";
    nlohmann::ordered_json graph = nlohmann::ordered_json::parse(read_text_file(source_dir() / "graphs" / file));
    graph["view"] = {{"width", kWidth}, {"height", kHeight}};
    graph["trace"] = graph["view"];
    if (graph["params"].contains("resolution")) graph["params"]["resolution"] = 24;
    std::ofstream(folder_ / "small.json") << graph.dump(1);
  }
  ~ShippedChecks() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  RenderRequest request_for(const std::string& out, const CheckOptions& checks) const {
    RenderRequest request;
    request.graph = folder_ / "small.json";
    request.scene = source_dir() / "samples/scenes/atrium.scene.json";
    request.last_frame = 2;
    if (GetParam().still) request.frozen_time = 0.5;
    request.out = folder_ / out;
    request.device.validate = checks.any();
    request.checks = checks;
    return request;
  }

  RenderSummary render_cleanly(const std::string& out, const CheckOptions& checks) {
    const RenderRequest request = request_for(out, checks);
    Diagnostics diagnostics;
    RenderSummary summary;
    EXPECT_TRUE(render(request, registry_, {}, diagnostics, summary));
    for (const Diagnostic& diagnostic : diagnostics.all()) ADD_FAILURE() << format_diagnostic(diagnostic);
    for (const std::string& warning : summary.warnings) ADD_FAILURE() << warning;
    for (const std::string& failure : summary.failures) ADD_FAILURE() << failure;
    return summary;
  }

  PassRegistry registry_;
  fs::path folder_;
};

TEST_P(ShippedChecks, FindNothingAndChangeNoBit) {
  render_cleanly("plain", {});
  render_cleanly("checked", {.find_nan = true, .stop_at_nan = true, .poison = true});
  size_t compared = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "plain")) {
    if (entry.path().extension() != ".png" && entry.path().extension() != ".exr") continue;
    ++compared;
    EXPECT_TRUE(read_text_file(entry.path()) == read_text_file(folder_ / "checked" / entry.path().filename()))
        << entry.path().filename();
  }
  EXPECT_GE(compared, 3U);
  const auto record = nlohmann::ordered_json::parse(read_text_file(folder_ / "checked/run.json"));
  EXPECT_EQ(record["non_finite"].dump(), R"({"made":[],"passed_on":[]})");
  EXPECT_EQ(record["unwritten"].dump(), "[]");
}

class FaultyShaders : public ShippedChecks {
 protected:
  /// Renders with a shader in which `text` stands as `fault`.
  RenderSummary render_with(const std::string& shader, const std::string& text, const std::string& fault) {
    std::string source = read_text_file(source_dir() / "shaders" / shader);
    const size_t at = source.find(text);
    EXPECT_NE(at, std::string::npos) << shader << " has changed: this test is to plant its fault elsewhere";
    if (at != std::string::npos) source.replace(at, text.size(), fault);
    fs::create_directories(folder_ / "shaders");
    std::ofstream(folder_ / "shaders" / shader) << source;
    RenderRequest request = request_for("faulty", {.find_nan = true, .poison = true});
    request.shaders.sources.insert(request.shaders.sources.begin(), folder_ / "shaders");
    Diagnostics diagnostics;
    RenderSummary summary;
    EXPECT_TRUE(render(request, registry_, {}, diagnostics, summary));
    fs::remove_all(folder_ / "shaders");
    return summary;
  }
};

TEST_P(FaultyShaders, AreNamedByTheirPass) {
  const std::string store = "imageStore(out_radiance, pixel, storable(result, out_radiance_largest));";
  RenderSummary summary = render_with("modulate.comp", store, "if (pixel.x != 7) " + store);
  EXPECT_EQ(summary.warnings, (std::vector<std::string>{
                                  "modulate.radiance: modulate leaves 36 of 1728 texels unwritten, first 7,0; frames "
                                  "0..2"}));
  EXPECT_EQ(summary.failures.size(), 1U);
  // A slice of scratch, of bytes, from which the pass takes minima.
  summary = render_with("distance_transform.comp", "else if (axis == 1) imageStore",
                        "else if (axis == 1 && voxel.z == 3) return;\n  else if (axis == 1) imageStore");
  ASSERT_EQ(summary.warnings.size(), 1U);
  EXPECT_EQ(summary.warnings[0].find("distance.distance: distance makes it of what nobody wrote"), 0U)
      << summary.warnings[0];
  summary = render_with("modulate.comp", store,
                        "if (pixel == ivec2(20, 11)) result.g = uintBitsToFloat(0x7fc00000u);\n  " + store);
  ASSERT_EQ(summary.warnings.size(), 1U);
  EXPECT_EQ(summary.warnings[0].find("modulate.radiance: modulate made NaN in 1 of 1728 texels, first at 20,11, ("), 0U)
      << summary.warnings[0];
  EXPECT_TRUE(summary.failures.empty());
}

INSTANTIATE_TEST_SUITE_P(Graph, FaultyShaders, ::testing::Values(Shipped{"lightloom", false}), test_name);

INSTANTIATE_TEST_SUITE_P(Graphs, ShippedChecks,
                         ::testing::Values(Shipped{"paper", false}, Shipped{"paper", true}, Shipped{"lightloom", false},
                                           Shipped{"lightloom", true}, Shipped{"stages", false},
                                           Shipped{"reference", false}),
                         test_name);

}  // namespace
}  // namespace lightloom::run
