#include "passes/temporal_accumulate.hpp"

#include <string>
#include <utility>
#include <vector>

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

constexpr float kUnknownVariance = 1e36f;  // as in shaders/lib/variance.glsl

constexpr const char* kMean =
    "Weighted mean of the traced frames of the recent past. Each surface point is followed to where its object and "
    "the camera were in every earlier frame; frames in which it was hidden are left out; the age weight follows a "
    "Hermite curve that is flat for a Lambertian surface and keeps only the current frame for a mirror (paper, "
    "section 2.3).";

/// What both types have, with `trails` for what earlier frames saw.
PassType make_temporal(const std::string& name, std::vector<Port> trails) {
  PassType type;
  type.name = name;
  Port radiance = image_output_like(
      "radiance", Format::rgba32_sfloat, "radiance",
      "rgb: accumulated radiance; a: sum of the weights (1 to `frames`), 0 where there is nothing to accumulate");
  radiance.bypass = Bypass{"radiance", {}};
  Port variance = image_output_like(
      "variance", Format::r32_sfloat, "radiance",
      "estimated variance of the luminance of the accumulated radiance: that of the accepted frames' weighted mean, "
      "from those frames where they are worth at least 4, else from up to 5 x 5 alike pixels of the current frame; "
      "1e36 where it is unknown, 0 where there is nothing to accumulate");
  variance.bypass = Bypass{"", {kUnknownVariance, 0, 0, 0}};
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "the current frame"),
                same_size_as("radiance", surface_input("surface", "G-buffer of the current frame")),
                same_size_as("radiance", history_input("trail", Format::rgba32_sfloat,
                                                       "`radiance` of earlier frames, raw (not accumulated)"))};
  for (Port& trail : trails) type.ports.push_back(same_size_as("radiance", std::move(trail)));
  type.ports.push_back(radiance);
  type.ports.push_back(variance);
  type.params = {
      choice_param("lobe", "both", {"both", "diffuse", "specular"},
                   "what the radiance holds, which decides how long it may be kept: `diffuse` light weighs all frames "
                   "alike, `specular` light weighs them by Ward's alpha, and `both` by what the surface reflects more"),
      integer_param("frames", 10, 1, 16, "frames",
                    "frames that contribute, the current one included; the trails' ranges limit it as well"),
      real_param("position_tolerance", 2.0, 0, 100, "pixels",
                 "largest distance between a point and what an earlier frame saw in its place, in footprints of a "
                 "pixel there"),
      real_param("normal_threshold", 0.9, -1, 1, "", "smallest cosine between the two normals"),
  };
  type.reads = FrameState::camera | FrameState::dynamic_geometry;
  type.record = one_dispatch(name + ".comp", "radiance");
  return type;
}

}  // namespace

PassType make_temporal_accumulate() {
  PassType type =
      make_temporal("temporal_accumulate",
                    {history_input("trail_position", Format::rgba32_sfloat, "`surface.position` of the same frames"),
                     history_input("trail_normal", Format::rgba16_sfloat, "`surface.normal` of the same frames"),
                     optional(history_input(
                         "trail_id", Format::rgba32_uint,
                         "`surface.id` of the same frames; without it objects and materials are not told apart"))});
  type.doc = kMean;
  return type;
}

PassType make_temporal_accumulate_packed() {
  PassType type = make_temporal(
      "temporal_accumulate_packed",
      {history_input("trail_point", Format::rgba32_uint, "`point` of `pack_surface` in the same frames")});
  type.doc = std::string(kMean) +
             " What earlier frames saw is packed by `pack_surface`: one load instead of three for each frame, and 16 "
             "bytes instead of 40.";
  return type;
}

}  // namespace lightloom::passes
