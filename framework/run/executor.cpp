#include "framework/run/executor.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/barriers.hpp"
#include "framework/run/device_needs.hpp"

namespace lightloom::run {
namespace {

Plan checked(Plan plan, const gpu::Device& device) {
  require_device_needs(plan.graph, device.info());
  return plan;
}

bool has_scans(const Plan& plan) {
  const auto scanned = [](const PlanStep& step) {
    return std::any_of(step.observations.begin(), step.observations.end(),
                       [](const Observation& observation) { return observation.observer == Observer::scan; });
  };
  return std::any_of(plan.once.begin(), plan.once.end(), scanned) ||
         std::any_of(plan.steps.begin(), plan.steps.end(), scanned);
}

uint32_t query_count(size_t steps) {
  return static_cast<uint32_t>(steps) * 2;
}

}  // namespace

Executor::Executor(gpu::Device& device, Plan plan, const scene::Scene& scene, const ExecutorOptions& options)
    : device_(device),
      plan_(checked(std::move(plan), device)),
      images_(device, plan_, options.share_memory),
      readback_(device, plan_, options.single_texels),
      host_passes_(device, plan_),
      scene_(device, scene,
             {.camera = options.camera,
              .camera_path = options.camera_path,
              .view = plan_.graph.view,
              .seed = options.seed,
              .frames_per_second = options.frames_per_second,
              .frozen_time = options.frozen_time,
              .general = plan_.graph.general,
              .ray_queries = needs_ray_queries(plan_.graph),
              .geometry_piece_bytes = options.geometry_piece_bytes}),
      memo_(options.memo ? options.memo : std::make_shared<SceneMemo>()),
      placeholders_(device),
      shaders_(options.library ? options.library : make_library(device, options.shaders)),
      descriptors_(device),
      timestamps_(device, options.time_passes ? query_count(plan_.steps.size() + plan_.once.size()) : 0) {
  if (options.poison) poison_.emplace(device_, plan_, *options.poison);
  if (has_scans(plan_)) scan_.emplace(device_, plan_, *shaders_, options.poison);
  device_.run_commands([&](VkCommandBuffer commands) {
    images_.record_initialisation(commands);
    if (poison_) poison_->record_initialisation(commands, images_);
    gpu::record_full_barrier(commands);
  });
}

Executor::~Executor() {
  try {
    device_.wait_commands();
  } catch (const Error&) {
    // A device that hangs or is lost has been reported, or whatever ends this object is.
  }
}

FrameResult Executor::run_frame(uint32_t frame, const FrameWants& wants) {
  stop_if_interrupted();
  start_frame(frame, wants);
  return fetch(finish_frame());
}

FrameResult Executor::repeat_frame(const FrameWants& wants) {
  stop_if_interrupted();
  if (!started_) throw std::logic_error("no frame has run yet that could be repeated");
  --frame_count_;
  start(recent_frames_.back(), wants);
  return fetch(finish());
}

void Executor::start_frame(uint32_t frame, const FrameWants& wants) {
  if (under_way_) throw std::logic_error("a frame was started while another one is under way");
  conditions_ = scene_.prepare(frame);
  start(frame, wants);
}

FinishedFrame Executor::finish_frame() {
  FinishedFrame frame = finish();
  remember(frame.result.frame);
  return frame;
}

void Executor::start(uint32_t frame, const FrameWants& wants) {
  FinishedFrame next{.result = {}, .wants = wants, .copies = readback_.acquire(wants)};
  next.result.frame = frame;
  next.result.conditions = conditions_;
  descriptors_.reset();
  stamping_ = wants.times && timestamps_.available();
  try {
    gpu::CommandSession session(device_);
    record_frame(session, *next.copies);
    session.start();
  } catch (const gpu::DeviceLost& lost) {
    throw in_frame(lost, lost_frame(frame));
  }
  under_way_ = std::move(next);
}

FinishedFrame Executor::finish() {
  if (!under_way_) throw std::logic_error("there is no frame under way to be finished");
  FinishedFrame frame = std::move(*under_way_);
  under_way_.reset();
  try {
    device_.wait_commands();
    collect_times(frame);
  } catch (const gpu::DeviceLost& lost) {
    throw in_frame(lost, lost_frame(frame.result.frame));
  }
  if (scan_) frame.result.scanned = scan_->found();
  ++frame_count_;
  started_ = true;
  return frame;
}

FrameResult Executor::fetch(const FinishedFrame& frame) const {
  const Graph& graph = plan_.graph;
  FrameResult result = frame.result;
  if (frame.wants.outputs)
    for (const GraphOutput& output : graph.outputs)
      result.outputs.push_back({output.name, frame.copies->fetch(output.value, output.age)});
  if (frame.wants.captures)
    for (const ValueId capture : graph.captures)
      result.captures.push_back({value_name(graph.values[capture]), frame.copies->fetch(capture, 0)});
  return result;
}

void Executor::remember(uint32_t frame) {
  recent_frames_.push_back(frame);
  if (recent_frames_.size() > kHistoryLimit) recent_frames_.erase(recent_frames_.begin());
}

ExecutorState Executor::save() const {
  return {.frame_count = frame_count_,
          .recent_frames = recent_frames_,
          .layers = save_layers(device_, plan_.graph, images_, frame_count_)};
}

void Executor::run_prologue() {
  device_.run_commands([&](VkCommandBuffer commands) {
    record_prologue(commands);
    gpu::record_full_barrier(commands);
  });
  initialised_ = true;
}

void Executor::restore(const ExecutorState& state) {
  run_prologue();
  restore_layers(device_, plan_.graph, images_, state.frame_count, state.layers);
  pass_through(state.recent_frames);
  frame_count_ = state.frame_count;
}

void Executor::start_at(const FrameStart& start) {
  run_prologue();
  give_layers(device_, plan_.graph, images_, start);
  pass_through(start.recent_frames);
  frame_count_ = start.frame_count;
}

void Executor::pass_through(const std::vector<uint32_t>& frames) {
  // The scene's own history, views and positions, follows from the numbers of the frames.
  for (const uint32_t frame : frames) {
    static_cast<void>(scene_.prepare(frame));
    device_.run_commands([&](VkCommandBuffer commands) {
      gpu::record_full_barrier(commands);
      scene_.record_upload(commands);
      gpu::record_full_barrier(commands);
    });
    remember(frame);
  }
}

void Executor::record_prologue(VkCommandBuffer commands) const {
  for (const Clear& clear : plan_.prologue) images_.record_clear(commands, clear);
  record_barriers(commands, plan_.prologue_barriers);
}

void Executor::record_frame(gpu::CommandSession& session, const FrameCopies& copies) {
  const bool first = !started_;
  timestamps_.reset(session.get());
  if (scan_) scan_->record_begin(session.get());
  if (!initialised_) record_prologue(session.get());
  initialised_ = true;
  record_barriers(session.get(), plan_.frame_start);
  scene_.record_upload(session.get());
  record_barriers(session.get(), plan_.inputs_ready);
  if (first) {
    record_steps(session, plan_.once, query_count(plan_.steps.size()), copies);
    record_barriers(session.get(), plan_.once_barriers);
  }
  record_observations(session.get(), plan_.opening_observations, copies);
  record_steps(session, plan_.steps, 0, copies);
  if (scan_) scan_->record_end(session.get());
  Readback::record_end(session.get());
}

void Executor::record_steps(gpu::CommandSession& session, const std::vector<PlanStep>& steps, uint32_t first_query,
                            const FrameCopies& copies) {
  uint32_t query = first_query;
  for (const PlanStep& step : steps) {
    const GraphPass& pass = plan_.graph.passes[step.pass];
    record_barriers(session.get(), step.barriers, images_.takeovers(step.barriers));
    if (poison_) poison_->record_before(session.get(), pass, images_, frame_count_);
    record_timestamp(session.get(), query++);
    if (pass.type->host)
      run_host_pass(session, pass);
    else
      record_pass(session.get(), pass);
    record_timestamp(session.get(), query++);
    record_observations(session.get(), step.observations, copies);
    if (poison_) poison_->record_after(session.get(), pass, images_, frame_count_);
  }
}

void Executor::record_pass(VkCommandBuffer commands, const GraphPass& pass) {
  PassRecorder recorder({.commands = commands,
                         .images = &images_,
                         .frame_count = frame_count_,
                         .scene = &scene_.bindings(),
                         .placeholders = &placeholders_,
                         .shaders = shaders_.get(),
                         .descriptors = &descriptors_,
                         .watch = &watch_},
                        plan_.graph, pass);
  pass.type->record(recorder);
  recorder.finish();
  watch_.ends(plan_.graph, pass);
}

void Executor::run_host_pass(gpu::CommandSession& session, const GraphPass& pass) {
  host_passes_.record_inputs(session.get(), pass, images_, frame_count_);
  session.submit();
  host_milliseconds_[pass.name] =
      host_passes_.run(plan_.graph, pass, {.scene = &scene_.frame_scene(), .memo = memo_.get()});
  host_passes_.record_outputs(session.get(), plan_.graph, pass, images_, frame_count_);
}

void Executor::record_timestamp(VkCommandBuffer commands, uint32_t query) const {
  if (!stamping_) return;
  // Passes are timed one by one: nothing may overlap the stamp. The barrier after it also makes lavapipe, which puts
  // stamps off until something flushes, take it here.
  gpu::record_full_barrier(commands);
  timestamps_.write(commands, query);
  gpu::record_full_barrier(commands);
}

void Executor::record_observations(VkCommandBuffer commands, const std::vector<Observation>& observations,
                                   const FrameCopies& copies) {
  for (const Observation& observation : observations) {
    // Also where nothing is copied: later barriers of the plan may build on these.
    record_barriers(commands, observation.barriers);
    if (observation.observer == Observer::scan)
      scan_->record(commands, observation, images_, frame_count_);
    else
      readback_.record(commands, observation, images_, frame_count_, copies);
  }
}

LostFrame Executor::lost_frame(uint32_t frame) const {
  LostFrame lost{.frame = frame, .passes = {}, .written = std::nullopt};
  // The passes that run once come first, but their queries are behind the others.
  const size_t queries = query_count(plan_.steps.size());
  const std::vector<PlanStep> once = started_ ? std::vector<PlanStep>() : plan_.once;
  for (const std::vector<PlanStep>* steps : {&once, &plan_.steps})
    for (const PlanStep& step : *steps) lost.passes.push_back(plan_.graph.passes[step.pass].name);
  // A CPU that is asked for its times ends its work first, which here it never may.
  if (!stamping_ || (device_.hangs() && device_.info().type == gpu::DeviceType::cpu)) return lost;
  const auto written = timestamps_.written(static_cast<uint32_t>(queries) + query_count(once.size()));
  if (!written) return lost;
  const auto first_once = written->begin() + static_cast<std::ptrdiff_t>(queries);
  lost.written.emplace(first_once, written->end());
  lost.written->insert(lost.written->end(), written->begin(), first_once);
  return lost;
}

void Executor::collect_times(FinishedFrame& frame) const {
  const bool first = !started_;
  FrameResult& result = frame.result;
  std::vector<double> stamps;
  if (frame.wants.times)
    stamps = timestamps_.nanoseconds(query_count(plan_.steps.size() + (first ? plan_.once.size() : 0)));
  result.times = times_of(plan_.steps, stamps, 0);
  if (first) result.once_times = times_of(plan_.once, stamps, query_count(plan_.steps.size()));
}

std::vector<PassTime> Executor::times_of(const std::vector<PlanStep>& steps, const std::vector<double>& stamps,
                                         size_t first_query) const {
  std::vector<PassTime> times;
  for (size_t step = 0; step < steps.size(); ++step) {
    const std::string& pass = plan_.graph.passes[steps[step].pass].name;
    const size_t query = first_query + 2 * step;
    const auto host = host_milliseconds_.find(pass);
    if (host != host_milliseconds_.end())
      times.push_back({pass, host->second});
    else
      times.push_back({pass, stamps.empty() ? -1 : (stamps.at(query + 1) - stamps.at(query)) * 1e-6});
  }
  return times;
}

}  // namespace lightloom::run
