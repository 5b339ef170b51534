#pragma once

#include <filesystem>

#include "framework/run/brdf.hpp"

namespace lightloom::run {

/// Draws a lobe into a PNG file, in three panels: f cos(theta of wo) of all forms in the plane of incidence, as radius
/// over the angle of wo (scaled to the form of `lobe`); the same of `lobe` over the hemisphere of wo, seen from above
/// in equal areas, with wi (ring) and wo (dot) of `pair`; the directional albedo of all forms over theta, at the phi of
/// wi. The file's folder is made if missing. Throws Error(run_failed) if the file cannot be written.
void plot_brdf(BrdfEvaluator& evaluator, const WardLobe& lobe, const DirectionPair& pair,
               const std::filesystem::path& file);

}  // namespace lightloom::run
