#include "passes/modulate.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_modulate() {
  PassType type;
  type.name = "modulate";
  type.doc =
      "Multiplies radiance by the surface's modulation colour and adds its emission; the background shows the "
      "environment (paper, section 2.5). With `specular` connected, `radiance` is the diffuse part, and each part is "
      "multiplied by the colour of its own lobe.";
  Port radiance = image_output_like("radiance", Format::rgba32_sfloat, "surface",
                                    "rgb: radiance towards the viewer [W m^-2 sr^-1]; a: 1 on a surface, else 0");
  radiance.bypass = Bypass{"radiance", {}};
  Port specular = same_size_as("radiance", image_input("specular", Format::rgba32_sfloat,
                                                       "specular part of the radiance, divided by its own colour"));
  specular.optional = true;
  type.ports = {image_input("radiance", Format::rgba32_sfloat,
                            "radiance divided by the modulation colour; with `specular`, the diffuse part of it "
                            "divided by the diffuse colour"),
                specular, same_size_as("radiance", surface_input("surface", "G-buffer of the same pixels")), radiance};
  type.reads = FrameState::camera | FrameState::lights;
  type.record = one_dispatch("modulate.comp", "radiance");
  return type;
}

}  // namespace lightloom::passes
