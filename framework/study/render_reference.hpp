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
/// In a scene that stands still the frames of a reference follow one another from the judged frame on, after the
/// study's own frames if its graph looks back. In one that moves, the mean is over renderings of the judged frame with
/// seeds `seed`, `seed + 1`, …, and what is not a mean is the last of the frames that end there.
[[nodiscard]] RenderedReference render_reference(gpu::Device& device, const StudyPlan& plan,
                                                 const PlannedReference& reference, const FrameCallback& on_frame = {});

/// So many frames does render_reference render; 0 for an image.
[[nodiscard]] uint32_t reference_frames(const StudyPlan& plan, const PlannedReference& reference);

}  // namespace lightloom::study
