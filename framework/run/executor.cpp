#include "framework/run/executor.hpp"

#include <algorithm>
#include <utility>

#include "framework/gpu/transfer.hpp"
#include "framework/run/barriers.hpp"

namespace lightloom::run {

Executor::Executor(gpu::Device& device, Plan plan, const scene::Scene& scene, const ExecutorOptions& options)
    : device_(device),
      plan_(std::move(plan)),
      images_(device, plan_),
      readback_(device, plan_),
      scene_(device, scene,
             {.camera = options.camera,
              .camera_path = options.camera_path,
              .view = plan_.graph.view,
              .seed = options.seed,
              .frames_per_second = options.frames_per_second}),
      placeholders_(device),
      shaders_(device, {.include_directories = options.shaders.sources, .cache_directory = options.shaders.cache}),
      descriptors_(device),
      timestamps_(device, static_cast<uint32_t>(std::max<size_t>(plan_.steps.size(), 1)) * 2) {
  device_.run_commands([&](VkCommandBuffer commands) {
    images_.record_initialisation(commands, plan_);
    gpu::record_full_barrier(commands);
  });
}

FrameResult Executor::run_frame(uint32_t frame) {
  const FrameConditions conditions = scene_.prepare(frame);
  descriptors_.reset();
  device_.run_commands([&](VkCommandBuffer commands) { record_frame(commands); });
  ++frame_count_;
  return collect(frame, conditions);
}

void Executor::record_frame(VkCommandBuffer commands) {
  timestamps_.reset(commands);
  record_barriers(commands, plan_.frame_start);
  scene_.record_upload(commands);
  record_barriers(commands, plan_.inputs_ready);
  record_copies(commands, plan_.opening_copies);
  const RecordingEnvironment environment{.commands = commands,
                                         .images = &images_,
                                         .frame_count = frame_count_,
                                         .scene = &scene_.bindings(),
                                         .placeholders = &placeholders_,
                                         .shaders = &shaders_,
                                         .descriptors = &descriptors_};
  uint32_t query = 0;
  for (const PlanStep& step : plan_.steps) {
    const GraphPass& pass = plan_.graph.passes[step.pass];
    record_barriers(commands, step.barriers);
    record_timestamp(commands, query++);
    PassRecorder recorder(environment, plan_.graph, pass);
    pass.type->record(recorder);
    record_timestamp(commands, query++);
    record_copies(commands, step.copies);
  }
  Readback::record_end(commands);
}

void Executor::record_timestamp(VkCommandBuffer commands, uint32_t query) const {
  // Passes are timed one by one: nothing may overlap the stamp. The barrier after it also makes lavapipe, which puts
  // stamps off until something flushes, take it here.
  gpu::record_full_barrier(commands);
  timestamps_.write(commands, query);
  gpu::record_full_barrier(commands);
}

void Executor::record_copies(VkCommandBuffer commands, const std::vector<Copy>& copies) const {
  for (const Copy& copy : copies) {
    record_barriers(commands, copy.barriers);
    readback_.record(commands, copy, images_, frame_count_);
  }
}

FrameResult Executor::collect(uint32_t frame, const FrameConditions& conditions) const {
  const Graph& graph = plan_.graph;
  FrameResult result{.frame = frame, .conditions = conditions, .outputs = {}, .captures = {}, .times = {}};
  for (const GraphOutput& output : graph.outputs)
    result.outputs.push_back({output.name, readback_.fetch(output.value, output.age)});
  for (const ValueId capture : graph.captures)
    result.captures.push_back({value_name(graph.values[capture]), readback_.fetch(capture, 0)});
  const std::vector<double> times = timestamps_.nanoseconds(static_cast<uint32_t>(plan_.steps.size()) * 2);
  for (size_t step = 0; step < plan_.steps.size(); ++step) {
    const double nanoseconds = times.empty() ? -1e6 : times[2 * step + 1] - times[2 * step];
    result.times.push_back({graph.passes[plan_.steps[step].pass].name, nanoseconds * 1e-6});
  }
  return result;
}

}  // namespace lightloom::run
