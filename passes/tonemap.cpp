#include "passes/tonemap.hpp"

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_tonemap() {
  PassType type;
  type.name = "tonemap";
  type.doc =
      "Linear radiance to display values: exposure, tone curve, sRGB encoding (IEC 61966-2-1). The filmic curve is "
      "Narkowicz' rational fit of the ACES curve; reinhard is x / (1 + x).";
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "linear radiance"),
                image_output_like("image", Format::rgba8_unorm, "radiance", "sRGB-encoded colour; a: 1")};
  type.params = {
      real_param("exposure", 0.0, -32, 32, "EV", "radiance is multiplied by 2 to this power"),
      choice_param("curve", "filmic", {"filmic", "reinhard", "linear"},
                   "how radiance above 1 is compressed; linear clips it"),
  };
  type.record = one_dispatch("tonemap.comp", "image");
  return type;
}

}  // namespace lightloom::passes
