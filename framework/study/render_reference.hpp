#pragma once

#include <vector>

#include "framework/study/plan_study.hpp"
#include "framework/study/study_folder.hpp"

namespace lightloom::study {

struct RenderedReference {
  std::vector<image::HostImage> radiance;  ///< rgba32_sfloat, of the judged frames
  ReferenceRecord record;
};

/// Renders, or reads, a reference for each judged frame.
///
/// What is not a mean is the last of frames that follow one another from the judged frame on, while the scene stands
/// still as it is in that frame. A mean is over such frames too in a scene that does not move, after the study's own
/// frames if the graph looks back; in one that moves it is over renderings of the judged frame with seeds `seed`,
/// `seed + 1`, …, each with the study's frames before it if the graph looks back.
[[nodiscard]] RenderedReference render_reference(gpu::Device& device, const StudyPlan& plan,
                                                 const PlannedReference& reference, const FrameCallback& on_frame = {});

}  // namespace lightloom::study
