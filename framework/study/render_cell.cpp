#include "framework/study/render_cell.hpp"

#include <algorithm>
#include <chrono>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/run/executor.hpp"

namespace lightloom::study {
namespace {

using Clock = std::chrono::steady_clock;

bool is_radiance(const ImageDesc& desc) {
  return desc.dimension == Dimension::d2 &&
         (desc.format == Format::rgba16_sfloat || desc.format == Format::rgba32_sfloat);
}

std::optional<image::HostImage> output_of(const run::FrameResult& frame, const std::string& name) {
  for (const run::NamedImage& output : frame.outputs)
    if (output.name == name) return output.image;
  return std::nullopt;
}

void add_times(CellTimes& times, const run::FrameResult& frame, double wall) {
  std::vector<double> passes;
  times.passes.clear();
  for (const run::PassTime& pass : frame.times) {
    times.passes.push_back(pass.pass);
    passes.push_back(pass.milliseconds);
  }
  times.frames.push_back(std::move(passes));
  for (const run::PassTime& pass : frame.once_times) times.once.emplace_back(pass.pass, pass.milliseconds);
  times.wall.push_back(wall);
}

}  // namespace

size_t judged_output(const Graph& graph, const std::string& name) {
  std::vector<std::string> names;
  for (size_t i = 0; i < graph.outputs.size(); ++i) {
    names.push_back(graph.outputs[i].name);
    if (names.back() != name) continue;
    if (is_radiance(graph.values[graph.outputs[i].value].desc)) return i;
    throw Error(ExitCode::invalid_input,
                "output '" + name + "' of graph '" + graph.name + "' is no image of linear radiance",
                "a study judges a colour image of floating-point numbers; \"output\" names another one");
  }
  throw Error(ExitCode::invalid_input, "graph '" + graph.name + "' has no output '" + name + "' to judge",
              did_you_mean(name, names, "\"output\" of the study names one of its outputs"));
}

Rendering render_job(gpu::Device& device, const RenderJob& job, const FrameCallback& on_frame) {
  const size_t output = judged_output(job.plan.graph, job.output);
  const Clock::time_point start = Clock::now();
  run::Executor executor(device, job.plan, *job.scene,
                         {.shaders = job.shaders,
                          .camera = job.camera,
                          .seed = job.seed,
                          .frames_per_second = job.frames_per_second,
                          .frozen_time = job.frozen_time,
                          .memo = job.memo});
  Rendering rendering;
  Clock::time_point before = start;  // the first frame's wall time has what is set up for it
  for (uint32_t i = 0; i < job.frames; ++i) {
    run::FrameResult frame = executor.run_frame(job.first_frame + i);
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - before;
    add_times(rendering.times, frame, elapsed.count());
    if (i + job.kept >= job.frames) {
      rendering.frame_numbers.push_back(frame.frame);
      rendering.radiance.push_back(std::move(frame.outputs[output].image));
    }
    if (i + 1 == job.frames) {
      rendering.picture = output_of(frame, "image");
      rendering.standard_error = output_of(frame, "standard_error");
    }
    if (on_frame) on_frame();
    before = Clock::now();
  }
  if (rendering.picture && rendering.picture->desc.format != Format::rgba8_unorm) rendering.picture.reset();
  rendering.times.memory_bytes = executor.value_bytes();
  rendering.warnings = executor.scene_warnings();
  return rendering;
}

}  // namespace lightloom::study
