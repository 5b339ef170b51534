#pragma once

#include <string>
#include <vector>

#include "tests/passes/light_support.hpp"

namespace lightloom::test {

constexpr uint32_t kTemporalSize = 48;

/// A quad that fills the view.
scene::Scene wall(const scene::Material& material);

scene::Material metal(float roughness);

/// Test pass: position of the surface, moved by a metre towards the viewer in odd frames.
PassType make_test_displace();

/// Graph of `gather`, a test `pattern` and `temporal` (10 frames), all of kTemporalSize. `position`: the value that the
/// trail of positions is made of. `params`: of `temporal`, as JSON members. `packed`: by what `pack_surface` makes of
/// the G-buffer, whatever `position` is. Outputs: radiance, current, variance.
std::string temporal_graph(const std::string& pattern, const std::string& params = "",
                           const std::string& position = "gather.surface.position", bool packed = false);

/// Runs it with the test passes `pattern` and `test_displace`.
std::vector<Images> run_temporal(const scene::Scene& scene, const std::string& graph, uint32_t frames,
                                 const LinkOptions& link = {});

/// Variance over all pixels of one channel.
double variance_of(const image::HostImage& image, uint32_t channel = 0);

/// (sum of the weights)^2 / sum of their squares, of 10 frames of a surface of that roughness: the Hermite family of
/// the notes, computed on the host.
double effective_frames(double roughness);
double weight_sum(double roughness);

/// Variance of the luminance of the pattern `noise`: three independent numbers, uniform in [0, 1).
constexpr double kNoiseVariance = (0.2126 * 0.2126 + 0.7152 * 0.7152 + 0.0722 * 0.0722) / 12;

}  // namespace lightloom::test
