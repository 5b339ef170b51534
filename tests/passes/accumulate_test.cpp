// The progressive mean against sums in double precision of signals that a host pass makes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "framework/graph/graph_spec.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "passes/registry.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kWidth = 13;
constexpr uint32_t kHeight = 7;
constexpr uint32_t kPixels = kWidth * kHeight;
constexpr double kUnknown = 1e4;

/// Value of a channel (3: alpha) of a pixel in a frame.
using Signal = std::function<float(uint32_t frame, uint32_t pixel, uint32_t channel)>;

Port host_output(const std::string& name) {
  Port port;
  port.name = name;
  port.direction = Direction::out;
  port.parts = {{"", Format::rgba32_sfloat, ""}};
  port.extent = ExtentRule::trace;
  port.access = Access::transfer_write;
  return port;
}

PassType make_signal(const Signal& radiance, const Signal& error) {
  PassType type;
  type.name = "test_signal";
  type.doc = "For tests.";
  type.ports = {host_output("radiance"), host_output("error")};
  type.reads = FrameState::time;
  type.host = [radiance, error](HostContext& context) {
    for (const auto& [port, signal] : {std::pair("radiance", radiance), std::pair("error", error)}) {
      const HostOutput output = context.output(port, "");
      for (uint32_t i = 0; signal && i < kPixels * 4; ++i) {
        const float value = signal(context.scene().frame, i / 4, i % 4);
        std::memcpy(output.texels.data() + i * sizeof value, &value, sizeof value);
      }
    }
  };
  return type;
}

scene::Scene still_scene() {
  return make_quad_scene({{{-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 0}}, {}, look_at({0, 0, 3}, {0, 0, 0}, 0.8f));
}

std::string accumulate_text(bool own_errors) {
  return graph_text(kWidth, kHeight, kWidth, kHeight,
                    R"("signal": { "type": "test_signal" }, "mean": { "type": "accumulate",
                         "in": { "radiance": "signal.radiance", "past": "mean.accumulation@1")" +
                        std::string(own_errors ? R"(, "standard_error": "signal.error")" : "") + "} }",
                    R"("radiance": "mean.radiance", "error": "mean.standard_error")");
}

/// All frames' images.
std::vector<Images> accumulate(uint32_t frames, const Signal& radiance, const Signal& error = nullptr,
                               const LinkOptions& link = {}) {
  GraphRunOptions options;
  options.frames = frames;
  options.link = link;
  options.extra_types = {make_signal(radiance, error)};
  return run_graph(accumulate_text(error != nullptr), still_scene(), options);
}

class Accumulate : public DeviceTest {};

/// Log-normal with a heavy tail, the same number for the same place.
float heavy(uint32_t frame, uint32_t pixel, uint32_t channel) {
  if (channel == 3) return 1;
  std::mt19937 random(frame * 7919 + pixel * 31 + channel);
  return std::lognormal_distribution<float>(0, 2)(random);
}

TEST_F(Accumulate, MeanAndErrorAreThoseOfDoublePrecision) {
  constexpr uint32_t kFrames = 120;
  const std::vector<Images> frames = accumulate(kFrames, heavy);
  for (const uint32_t count : {1u, 2u, 3u, 17u, kFrames}) {
    const image::HostImage& mean = frames[count - 1].at("radiance");
    const image::HostImage& error = frames[count - 1].at("error");
    for (uint32_t i = 0; i < kPixels * 3; ++i) {
      const uint32_t pixel = i / 3, channel = i % 3, x = pixel % kWidth, y = pixel / kWidth;
      double sum = 0, squares = 0;
      for (uint32_t frame = 0; frame < count; ++frame) sum += static_cast<double>(heavy(frame, pixel, channel));
      for (uint32_t frame = 0; frame < count; ++frame)
        squares += std::pow(static_cast<double>(heavy(frame, pixel, channel)) - sum / count, 2);
      EXPECT_NEAR(mean.at(x, y, 0, channel), sum / count, 2e-7 * sum / count);
      const double expected = count < 2 ? kUnknown : std::sqrt(squares / (count - 1) / count);
      EXPECT_NEAR(error.at(x, y, 0, channel), expected, 1e-5 * expected) << count;
    }
    EXPECT_EQ(mean.at(0, 0, 0, 3), count);
    EXPECT_EQ(error.at(0, 0, 0, 3), count);
  }
}

TEST_F(Accumulate, AConstantStaysWhatItIs) {
  const std::vector<Images> frames = accumulate(400, [](uint32_t, uint32_t, uint32_t) { return 0.1f; });
  const Images& last = frames.back();
  EXPECT_EQ(last.at("radiance").at(3, 2, 0, 1), static_cast<double>(0.1f));
  EXPECT_NEAR(last.at("error").at(3, 2, 0, 1), 0, 1e-9);
}

TEST_F(Accumulate, TheFramesOwnErrorsCountFromTheFirstOn) {
  const Signal errors = [](uint32_t frame, uint32_t, uint32_t channel) {
    return 0.5f * static_cast<float>(frame + 1) * static_cast<float>(channel + 1);
  };
  const std::vector<Images> frames = accumulate(20, heavy, errors);
  double squares = 0;
  for (uint32_t frame = 0; frame < 20; ++frame) {
    squares += 0.25 * (frame + 1) * (frame + 1);
    const double expected = 2 * std::sqrt(squares) / (frame + 1);
    EXPECT_NEAR(frames[frame].at("error").at(5, 5, 0, 1), expected, 1e-6 * expected);
  }
}

/// As those of a single path, of which nobody knows the error.
TEST_F(Accumulate, WhereTheFramesErrorsAreNotKnownTheirSpreadCounts) {
  const std::vector<Images> without = accumulate(30, heavy);
  const std::vector<Images> zeros = accumulate(30, heavy, [](uint32_t, uint32_t, uint32_t) { return 0.0f; });
  for (const uint32_t frame : {1u, 2u, 29u})
    EXPECT_EQ(zeros[frame].at("error").texels, without[frame].at("error").texels) << frame;
  EXPECT_EQ(zeros[0].at("error").at(4, 4, 0, 1), 0);
  const Signal every_third = [](uint32_t frame, uint32_t, uint32_t) { return frame % 3 == 0 ? 0.5f : 0.0f; };
  const Signal noise = [](uint32_t frame, uint32_t pixel, uint32_t channel) {
    std::mt19937 random(frame * 7919 + pixel * 31 + channel);
    return std::normal_distribution<float>(3, 0.5f)(random);
  };
  const image::HostImage error = accumulate(60, noise, every_third).back().at("error");
  double squares = 0;
  for (uint32_t i = 0; i < kPixels * 3; ++i)
    squares += std::pow(error.at(i / 3 % kWidth, i / 3 / kWidth, 0, i % 3), 2) / (kPixels * 3);
  EXPECT_NEAR(std::sqrt(squares), 0.5 / std::sqrt(60), 0.03 * 0.5 / std::sqrt(60)) << "known and unknown errors mix";
}

TEST_F(Accumulate, FramesWithoutNumbersAreLeftOut) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Signal spoilt = [](uint32_t frame, uint32_t pixel, uint32_t channel) {
    if (channel == 3) return 1.0f;
    if (pixel == 4 && frame == 0) return kNaN;
    if (pixel == 5 && frame == 3 && channel == 2) return -kInfinity;
    if (pixel == 6) return 3e38f;
    if (pixel == 7) return kNaN;
    return static_cast<float>(frame);
  };
  const Images images = accumulate(6, spoilt).back();
  const auto at = [&](const char* name, uint32_t pixel, uint32_t channel) {
    return images.at(name).at(pixel % kWidth, pixel / kWidth, 0, channel);
  };
  EXPECT_EQ(at("radiance", 0, 0), 2.5);
  EXPECT_EQ(at("radiance", 4, 0), 3);
  EXPECT_EQ(at("radiance", 4, 3), 5);
  EXPECT_NEAR(at("radiance", 5, 0), 2.4, 1e-6) << "the whole frame, so that colours do not shift";
  EXPECT_EQ(at("radiance", 6, 0), static_cast<double>(3e38f)) << "what would overflow the sum";
  EXPECT_EQ(at("radiance", 7, 0), 0);
  EXPECT_EQ(at("radiance", 7, 3), 0);
  EXPECT_EQ(at("error", 7, 0), kUnknown);
  for (const char* name : {"radiance", "error"})
    for (uint32_t i = 0; i < kPixels * 4; ++i) EXPECT_TRUE(std::isfinite(at(name, i / 4, i % 4))) << name << i;
}

TEST_F(Accumulate, TheBackgroundIsAveragedAndKnownAsSuch) {
  const Signal half = [](uint32_t frame, uint32_t pixel, uint32_t channel) {
    if (channel == 3) return pixel < 10 ? 0.0f : 7.0f;
    return static_cast<float>(frame + 1);
  };
  const Images images = accumulate(3, half).back();
  EXPECT_EQ(images.at("radiance").at(2, 0, 0, 0), 2);
  EXPECT_EQ(images.at("radiance").at(2, 0, 0, 3), 0);
  EXPECT_EQ(images.at("radiance").at(11, 0, 0, 3), 3);
  EXPECT_EQ(images.at("error").at(2, 0, 0, 3), 3);
}

TEST_F(Accumulate, Disabled) {
  LinkOptions link;
  link.disables = {"mean"};
  const std::vector<Images> frames = accumulate(3, heavy, nullptr, link);
  EXPECT_EQ(frames[2].at("radiance").at(1, 0, 0, 2), static_cast<double>(heavy(2, 1, 2)));
  EXPECT_EQ(frames[2].at("error").at(1, 0, 0, 2), kUnknown);
}

TEST_F(Accumulate, BeginsAnewWhenTheViewMoves) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  registry.add(make_signal([](uint32_t frame, uint32_t, uint32_t) { return static_cast<float>(frame); }, nullptr));
  const scene::Scene scene = still_scene();
  Diagnostics diagnostics;
  const auto spec = parse_graph(accumulate_text(false), "mean.json", diagnostics);
  const auto graph = link(spec.value(), registry, {}, run::link_environment(&scene), diagnostics);
  scene::CameraPath path;
  for (const auto& [time, x] : {std::pair(0.0, 0.0), std::pair(2.0, 0.0), std::pair(3.0, 1.0), std::pair(9.0, 1.0)})
    path.keys.push_back({.time = time, .position = {x, 0, 3}, .aim = glm::dvec3(x, 0, 0), .vertical_fov = {}});
  path.interpolation = scene::PathInterpolation::linear;
  run::ExecutorOptions options;
  options.shaders = run::default_shader_folders();
  options.camera_path = path;
  options.frames_per_second = 1;
  run::Executor executor(device(), compile(graph.value()), scene, options);
  std::vector<double> means, counts;
  for (uint32_t frame = 0; frame < 6; ++frame) {
    const run::FrameResult result = executor.run_frame(frame);
    means.push_back(result.outputs[0].image.at(0, 0, 0, 0));
    counts.push_back(result.outputs[1].image.at(0, 0, 0, 3));
  }
  EXPECT_EQ(means, (std::vector<double>{0, 0.5, 1, 3, 3.5, 4}));
  EXPECT_EQ(counts, (std::vector<double>{1, 2, 3, 1, 2, 3}));
}

/// The sum alone, over a number of frames that would take minutes: a plain sum drifts away.
TEST_F(Accumulate, AHundredThousandFramesAreExactToRounding) {
  constexpr uint32_t kFrames = 100'000;
  constexpr const char* kBody = R"(
    #include "lib/compensated_sum.glsl"
    float signal(uint index, uint frame) {
      uint bits = (index * 100003u + frame) * 2654435761u;
      return float((bits ^ (bits >> 15)) >> 8) * (index == 0u ? 1e-7 : index == 1u ? 1.0 : 0.1) + 0.1;
    }
    void evaluate(uint index) {
      CompensatedSum s = CompensatedSum(vec3(0.0), vec3(0.0));
      float plain = 0.0;
      for (uint frame = 0u; frame < 100000u; frame += 2u) {   // lavapipe ends loops after 65535 rounds
        vec3 first = vec3(signal(index, frame), 1e10, 0.1);
        vec3 second = vec3(signal(index, frame + 1u), -1e10 + 1024.0, 0.1);
        add(s, first);
        add(s, second);
        plain += first.z;
        plain += second.z;
      }
      vec3 mean = value_of(s) / 100000.0;
      outputs[index * 4u] = mean.x;
      outputs[index * 4u + 1u] = mean.y;
      outputs[index * 4u + 2u] = mean.z;
      outputs[index * 4u + 3u] = plain / 100000.0;
    })";
  const std::vector<float> outputs = run_snippet(device(), kBody, {}, 12, 3);
  const auto signal = [](uint32_t index, uint32_t frame) {
    const uint32_t bits = (index * 100003u + frame) * 2654435761u;
    const float scale = index == 0 ? 1e-7f : index == 1 ? 1.0f : 0.1f;
    const float scaled = static_cast<float>((bits ^ (bits >> 15)) >> 8) * scale;
    return static_cast<double>(scaled + 0.1f);
  };
  for (uint32_t index = 0; index < 3; ++index) {
    double sum = 0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) sum += signal(index, frame);
    const double mean = sum / kFrames;
    EXPECT_NEAR(static_cast<double>(outputs[index * 4]), mean, 1.5e-7 * mean) << index;
    const double pairs = (static_cast<double>(1e10f) + static_cast<double>(-1e10f + 1024.0f)) / 2;
    EXPECT_NEAR(static_cast<double>(outputs[index * 4 + 1]), pairs, 1.5e-7 * pairs);
    EXPECT_NEAR(static_cast<double>(outputs[index * 4 + 2]), static_cast<double>(0.1f), 1e-8);
    EXPECT_GT(std::abs(static_cast<double>(outputs[index * 4 + 3]) - 0.1), 1e-5) << "the plain sum drifts";
  }
}

}  // namespace
}  // namespace lightloom::test
