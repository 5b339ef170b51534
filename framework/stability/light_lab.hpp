#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/stability/differences.hpp"
#include "framework/stability/lab.hpp"
#include "framework/stability/scenes.hpp"

// What the checks of light share.
namespace lightloom::stability {

/// A small room: a floor and a back wall that are glossy in part, a post, and a lamp of area light that emits
/// (1, 0.8, 0.5) [W m^-2 sr^-1]. Material 0: floor and wall; 1: lamp; 2: post, a rough metal.
[[nodiscard]] scene::Scene lamp_room();
/// The same with a sun, an image of a sky, and a point light.
[[nodiscard]] scene::Scene room_of_all_lights();
/// All that shines, times `factor`.
void scale_light(scene::Scene& scene, float factor);

/// One that ships, at 48x36, a grid of 32, the last of `frames` frames: its output `radiance`.
[[nodiscard]] image::HostImage render_shipped(Lab& lab, const std::string& graph, const scene::Scene& scene,
                                              uint32_t frames, uint32_t seed = 1);

/// How `trace` runs: gather, voxels, and voxel_path_trace alone.
struct TraceOptions {
  std::string params = R"("paths": 4, "bounces": 2)";  ///< of voxel_path_trace, as JSON members
  bool faces = false;                                  ///< emissive_faces as well, with nee voxel_faces
  int resolution = 32;
  uint32_t size = 32;  ///< [pixels], square
  uint32_t frames = 1;
  uint32_t seed = 1;
};

/// The outputs `radiance` of the pass trace (divided by the modulation colour) and `position`, frame by frame.
[[nodiscard]] std::vector<Images> trace(Lab& lab, const scene::Scene& scene, const TraceOptions& options);

/// Channels r, g, b that are no finite numbers.
[[nodiscard]] double non_finite(const image::HostImage& image);
/// Mean of a channel over all pixels with alpha above 0.
[[nodiscard]] double mean_channel(const image::HostImage& image, uint32_t channel);
/// Largest |a - factor b| over the largest of factor b in the image, over r, g, b.
[[nodiscard]] double difference_to_scaled(const image::HostImage& a, const image::HostImage& b, double factor);

}  // namespace lightloom::stability
