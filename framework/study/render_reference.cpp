#include "framework/study/render_reference.hpp"

#include <algorithm>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/image/metrics.hpp"
#include "framework/study/mean_image.hpp"

namespace lightloom::study {
namespace {

bool keeps_history(const Graph& graph) {
  return std::any_of(graph.values.begin(), graph.values.end(), [](const Value& value) { return value.history > 0; });
}

/// What a rendering of the reference consists of.
struct Schedule {
  uint32_t first = 0;
  uint32_t frames = 1;  ///< of one run
  uint32_t kept = 1;
  uint32_t runs = 1;    ///< with a seed each
  bool frozen = false;  ///< the scene stands still as it is in the judged frame
};

Schedule schedule_for(const StudyPlan& plan, const PlannedReference& reference, uint32_t judged) {
  const bool moves = plan.scenes[plan.views[reference.view].scene]->scene.duration > 0;
  const bool looks_back = keeps_history(reference.plan->graph);
  const uint32_t begin = looks_back ? plan.spec.first_frame : judged;
  const uint32_t lead = judged - begin;
  if (!reference.average) {
    // What is not a mean gathers in the graph itself, from the judged frame on, while nothing moves.
    return {judged, reference.frames, 1, 1, true};
  }
  if (moves) return {begin, lead + 1, 1, reference.frames, false};
  return {begin, lead + reference.frames, reference.frames, 1, false};
}

class ReferenceRenderer {
 public:
  ReferenceRenderer(gpu::Device& device, const StudyPlan& plan, const PlannedReference& reference,
                    const FrameCallback& on_frame)
      : device_(device), plan_(plan), reference_(reference), on_frame_(on_frame) {}

  RenderedReference run() {
    double noise = 0;
    bool known = true;
    for (const uint32_t judged : plan_.judged_frames) {
      const std::optional<double> one = add_frame(judged);
      known = known && one.has_value();
      noise += one.value_or(0);
    }
    result_.record.relmse = known ? noise / static_cast<double>(plan_.judged_frames.size()) : 0;
    result_.record.noise_known = known;
    result_.record.note = reference_.note;
    return std::move(result_);
  }

 private:
  /// The noise of the frame, where it is known.
  std::optional<double> add_frame(uint32_t judged) {
    const Schedule schedule = schedule_for(plan_, reference_, judged);
    const double epsilon = image::MetricOptions{}.epsilon;
    MeanImage mean;
    std::optional<image::HostImage> standard_error;
    for (uint32_t run = 0; run < schedule.runs; ++run) {
      RenderJob rendered = job(schedule, run);
      if (schedule.frozen) rendered.frozen_time = judged / rendered.frames_per_second;
      Rendering rendering = render_job(device_, rendered, on_frame_);
      for (const image::HostImage& radiance : rendering.radiance) mean.add(radiance);
      standard_error = std::move(rendering.standard_error);
    }
    result_.radiance.push_back(mean.mean());
    result_.record.frame_numbers.push_back(judged);
    if (mean.count() == 1 && standard_error) return relative_noise(result_.radiance.back(), *standard_error, epsilon);
    if (mean.count() > 1 && (schedule.runs > 1 || !keeps_history(reference_.plan->graph)))
      return mean.relative_noise(epsilon);
    return std::nullopt;
  }

  RenderJob job(const Schedule& schedule, uint32_t run) const {
    const PlannedView& view = plan_.views[reference_.view];
    const LoadedScene& scene = *plan_.scenes[view.scene];
    return {.plan = *reference_.plan,
            .scene = &scene.scene,
            .memo = scene.memo,
            .camera = view.camera,
            .seed = reference_.seed + run,
            .first_frame = schedule.first,
            .frames = schedule.frames,
            .kept = schedule.kept,
            .frames_per_second = plan_.spec.frames_per_second,
            .output = plan_.spec.output,
            .shaders = plan_.shaders};
  }

  gpu::Device& device_;
  const StudyPlan& plan_;
  const PlannedReference& reference_;
  const FrameCallback& on_frame_;
  RenderedReference result_;
};

}  // namespace

RenderedReference render_reference(gpu::Device& device, const StudyPlan& plan, const PlannedReference& reference,
                                   const FrameCallback& on_frame) {
  if (reference.plan) return ReferenceRenderer(device, plan, reference, on_frame).run();
  RenderedReference result;
  result.record.note = reference.note;
  for (size_t i = 0; i < reference.images.size(); ++i) {
    MeanImage colors;
    colors.add(read_radiance(reference.images[i]));
    result.radiance.push_back(colors.mean());
    result.record.frame_numbers.push_back(plan.judged_frames[i]);
  }
  return result;
}

}  // namespace lightloom::study
