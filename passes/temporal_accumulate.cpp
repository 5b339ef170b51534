#include "passes/temporal_accumulate.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_temporal_accumulate() {
  PassType type;
  type.name = "temporal_accumulate";
  type.doc =
      "Weighted mean of the traced frames of the recent past. Each surface point is projected into every earlier "
      "frame; frames in which it was hidden are left out; the age weight follows a Hermite curve that is flat for a "
      "Lambertian surface and keeps only the current frame for a mirror (paper, section 2.3).";
  Port radiance = image_output_like("radiance", Format::rgba32_sfloat, "radiance",
                                    "rgb: accumulated radiance; a: sum of the weights (1 to `frames`)");
  radiance.bypass = Bypass{"radiance", {}};
  type.ports = {
      image_input("radiance", Format::rgba32_sfloat, "the current frame"),
      same_size_as("radiance", surface_input("surface", "G-buffer of the current frame")),
      same_size_as("radiance", history_input("trail", Format::rgba32_sfloat,
                                             "`radiance` of earlier frames, raw (not accumulated)")),
      same_size_as("radiance",
                   history_input("trail_position", Format::rgba32_sfloat, "`surface.position` of the same frames")),
      same_size_as("radiance",
                   history_input("trail_normal", Format::rgba16_sfloat, "`surface.normal` of the same frames")),
      radiance,
  };
  type.params = {
      {"frames",
       ParamType::integer,
       int64_t{10},
       1,
       16,
       {},
       "frames",
       "frames that contribute, the current one included; the trails' ranges limit it as well"},
      {"position_tolerance",
       ParamType::real,
       2.0,
       0,
       100,
       {},
       "pixels",
       "largest distance between a point and what an earlier frame saw in its place, in footprints of a pixel there"},
      {"normal_threshold", ParamType::real, 0.9, -1, 1, {}, "", "smallest cosine between the two normals"},
  };
  type.reads = FrameState::camera;
  type.record = [](PassContext& context) {
    context.dispatch({"temporal_accumulate.comp", context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
