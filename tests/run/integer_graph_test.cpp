// Random graphs of integer kernels on the device against an interpreter on the host, bit for bit, however the graph is
// executed: with and without shared memory, in every order, with few barriers or many, observed or not, timed or not,
// hoisted or not. The device here runs commands in order, so this is about images, bindings, rings and layouts; that
// the barriers suffice is the verifier's and the validation layer's to say, who watch as well.
#include "tests/run/integer_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "framework/graph/graph_spec.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/verify.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "tests/run/toy_types.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

constexpr uint32_t kFrames = 6;

/// One way to execute a graph.
struct Way {
  bool share_memory = true;
  CompileOptions compile{};
  bool capture = false;
  bool time_passes = false;
  bool hoist = true;

  [[nodiscard]] std::string text() const {
    return std::string(share_memory ? "alias" : "no alias") + ", order " +
           std::to_string(static_cast<int>(compile.order)) + ", " + std::string(to_string(compile.sync)) +
           (capture ? ", captured" : "") + (time_passes ? ", timed" : "") + (hoist ? ", hoisted" : "");
  }
};

std::vector<Way> all_ways(uint32_t seed) {
  std::vector<Way> ways;
  for (const bool share : {true, false})
    for (const PassOrder order : {PassOrder::level, PassOrder::declared, PassOrder::random})
      for (const SyncPolicy sync : {SyncPolicy::minimal, SyncPolicy::conservative})
        for (const bool capture : {false, true})
          for (const bool timed : {false, true})
            for (const bool hoist : {true, false})
              ways.push_back({share, {.sync = sync, .order = order, .order_seed = seed}, capture, timed, hoist});
  return ways;
}

class IntegerGraphs : public test::DeviceTest {
 protected:
  static Plan plan_of(const std::string& text, const Way& way) {
    Diagnostics diagnostics;
    const std::optional<GraphSpec> spec = parse_graph(text, "test.json", diagnostics);
    LinkOptions options;
    options.hoist = way.hoist;
    if (way.capture) options.captures = {"*"};
    std::optional<Graph> graph;
    if (spec) graph = link(*spec, registry(), options, link_environment(&scene()), diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.sorted()) ADD_FAILURE() << format_diagnostic(diagnostic) << text;
    return graph ? compile(*graph, way.compile) : Plan{};
  }

  static const PassRegistry& registry() {
    static const PassRegistry all = [] {
      PassRegistry made;
      for (const PassType& type : toy::integer_types()) made.add(type);
      return made;
    }();
    return all;
  }

  static toy::IntegerGraph::Texels texels(const image::HostImage& image) {
    toy::IntegerGraph::Texels result(image.texels.size() / sizeof(uint32_t));
    std::memcpy(result.data(), image.texels.data(), image.texels.size());
    return result;
  }

  static const scene::Scene& scene() {
    static const scene::Scene one = toy::one_quad();
    return one;
  }

  static Executor executor_of(Plan plan, const Way& way) {
    ShaderFolders shaders = default_shader_folders();
    shaders.sources.push_back(source_dir() / "tests/run/shaders");
    return {device(),
            std::move(plan),
            scene(),
            {.shaders = shaders, .camera = {}, .share_memory = way.share_memory, .time_passes = way.time_passes}};
  }

  /// Runs the graph one way and compares every image that comes to the host. Returns how many did.
  static size_t check(const toy::IntegerGraph& graph, const Way& way) {
    Executor executor = executor_of(plan_of(graph.text(), way), way);
    const Plan& plan = executor.plan();
    const std::vector<MemoryNeed> needs = memory_needs(device(), plan.graph);
    const Verification verification = verify(plan, {&executor.memory_sharing(), needs});
    EXPECT_EQ(verification.violations, std::vector<std::string>{}) << print_plan(plan);
    passes_run += plan.steps.size() + plan.once.size();
    size_t images = 0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
      const FrameResult result = executor.run_frame(frame);
      for (const NamedImage& output : result.outputs)
        EXPECT_EQ(texels(output.image), graph.output(output.name, frame)) << output.name << " in frame " << frame;
      for (const NamedImage& capture : result.captures)
        EXPECT_EQ(texels(capture.image), graph.value(capture.name, frame)) << capture.name << " in frame " << frame;
      images += result.outputs.size() + result.captures.size();
    }
    return images;
  }

  static inline size_t passes_run = 0;  ///< not culled, in all plans of a test

  static void check_all(uint32_t first_seed, uint32_t graphs, uint32_t passes) {
    size_t images = 0;
    passes_run = 0;
    for (uint32_t seed = first_seed; seed < first_seed + graphs; ++seed) {
      toy::IntegerGraph graph(seed, passes);
      graph.play(kFrames);
      for (const Way& way : all_ways(seed)) {
        images += check(graph, way);
        if (HasFailure()) FAIL() << "seed " << seed << ", " << way.text() << "\n" << graph.text();
      }
    }
    RecordProperty("images_compared", static_cast<int>(images));
    RecordProperty("passes_in_plans", static_cast<int>(passes_run));
    EXPECT_GT(passes_run * 2, size_t{graphs} * all_ways(0).size() * passes);
    EXPECT_GT(images, size_t{graphs} * all_ways(0).size() * kFrames * 3 - 1);
  }
};

TEST_F(IntegerGraphs, ComputeWhatTheHostComputesHoweverTheyAreExecuted) {
  check_all(0, 2, 12);
}

// Minutes, so it is a test of its own in tests/CMakeLists.txt, with the label `slow`.
TEST_F(IntegerGraphs, DISABLED_ComputeWhatTheHostComputesInMany) {
  check_all(100, 25, 16);
}

// The positive control of the silence above: who leaves out the barriers of a step hears of it. Passes of one command
// each, as a barrier between two commands of a pass would serve the others as well.
TEST_F(IntegerGraphs, TheValidationLayerSeesBarriersThatAreLeftOut) {
  const Plan whole = plan_of(R"({"lightloom": 1, "name": "chain", "view": {"width": 5, "height": 3}, "passes": {
      "a": {"type": "integer_noise"}, "b": {"type": "integer_split", "in": {"x": "a.a"}},
      "c": {"type": "integer_join", "in": {"p": "b.p"}}, "d": {"type": "integer_paint", "in": {"x": "c.a"}}},
      "outputs": {"o": "d.a"}})",
                             Way{});
  ASSERT_EQ(whole.steps.size(), 4u);
  for (const SyncPolicy policy : {SyncPolicy::minimal, SyncPolicy::conservative}) {
    for (size_t step = 1; step < 4; ++step) {
      Plan mutant = compile(whole.graph, {.sync = policy});
      mutant.steps[step].barriers.clear();
      Executor executor = executor_of(std::move(mutant), {.share_memory = false});
      static_cast<void>(executor.run_frame(0));
      const std::vector<gpu::ValidationMessage> messages = device().validation_messages();
      const bool seen = std::any_of(messages.begin(), messages.end(), [](const gpu::ValidationMessage& message) {
        return message.id == "SYNC-HAZARD-READ-AFTER-WRITE";
      });
      EXPECT_TRUE(seen) << "step " << step << ", " << to_string(policy);
      device().clear_validation_messages();
    }
  }
}

}  // namespace
}  // namespace lightloom::run
