#include "framework/study/rate_meter.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/gpu/shader_values.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/study/statistics.hpp"

namespace lightloom::study {
namespace {

constexpr double kLongEnough = 4e-3;       ///< [s]; far more than what a timestamp and a dispatch take
constexpr uint32_t kMostTimes = 1u << 15;  ///< less than any device's limit of groups along z
constexpr int kTries = 7;

}  // namespace

RateMeter::RateMeter(gpu::Device& device, run::ShaderLibrary& library)
    : device_(device),
      library_(library),
      sink_(device, sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device, "sink"),
      stamps_(device, 2),
      descriptors_(device) {
  if (!stamps_.available())
    throw Error(ExitCode::run_failed,
                "device '" + device.info().name + "' has no timestamps, by which its rates could be measured");
}

RateMeter::Bound RateMeter::bind(const RateKernel& kernel) {
  const gpu::ShaderProgram& program = library_.program({"floors/" + kernel.shader});
  Bound bound;
  bound.pipeline = &library_.pipelines().compute(program, kernel.constants);
  gpu::ResourceMap resources = kernel.resources;
  resources.emplace("Sink", gpu::resource(sink_));
  bound.set = descriptors_.allocate(*bound.pipeline, resources);
  bound.params = gpu::encode_push_constants(bound.pipeline->reflection(), kernel.params);
  const std::array<uint32_t, 3>& local = program.reflection.local_size;
  for (size_t axis = 0; axis < 2; ++axis)
    bound.groups[axis] = (kernel.invocations[axis] + local[axis] - 1) / local[axis];
  return bound;
}

double RateMeter::seconds(const std::function<void(VkCommandBuffer)>& record) {
  device_.run_commands([&](VkCommandBuffer commands) {
    stamps_.reset(commands);
    // Full barriers around stamps, as between the passes that `bench` times (Executor::record_timestamp).
    for (uint32_t stamp = 0; stamp < 2; ++stamp) {
      gpu::record_full_barrier(commands);
      stamps_.write(commands, stamp);
      gpu::record_full_barrier(commands);
      if (stamp == 0) record(commands);
    }
  });
  return stamps_.nanoseconds(2).at(1) * 1e-9;
}

double RateMeter::best_rate(const std::function<void(VkCommandBuffer, uint32_t times)>& record) {
  const auto measure = [&](uint32_t times) {
    stop_if_interrupted();
    return seconds([&](VkCommandBuffer commands) { record(commands, times); });
  };
  static_cast<void>(measure(1));  // compiles, and brings memory in
  uint32_t times = 1;
  while (times < kMostTimes && measure(times) < kLongEnough) times *= 2;
  double best = measure(times);
  for (int again = 1; again < kTries; ++again) best = std::min(best, measure(times));
  return best > 0 ? times / best : 0;
}

double RateMeter::per_second(const RateKernel& kernel) {
  const Bound bound = bind(kernel);
  return best_rate([&](VkCommandBuffer commands, uint32_t times) {
    bound.pipeline->bind(commands, bound.set, bound.params);
    vkCmdDispatch(commands, bound.groups[0], bound.groups[1], times);
  });
}

double RateMeter::per_second(const std::function<void(VkCommandBuffer)>& record) {
  return best_rate([&](VkCommandBuffer commands, uint32_t times) {
    for (uint32_t i = 0; i < times; ++i) {
      if (i > 0) gpu::record_full_barrier(commands);
      record(commands);
    }
  });
}

double RateMeter::seconds_of_one_group(const RateKernel& kernel) {
  const Bound bound = bind(kernel);
  std::vector<double> times;
  for (int i = 0; i < 32; ++i)
    times.push_back(seconds([&](VkCommandBuffer commands) {
      bound.pipeline->bind(commands, bound.set, bound.params);
      vkCmdDispatch(commands, 1, 1, 1);
    }));
  return percentile(times, 0.5);
}

}  // namespace lightloom::study
