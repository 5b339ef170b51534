// An effect on the picture: a pass type in about thirty lines. What it reads and writes, it says; allocation,
// descriptors and barriers follow from that.
#include <framework/graph/plugin.hpp>
#include <passes/param_rows.hpp>
#include <passes/port_rows.hpp>

namespace {

using namespace lightloom;
using namespace lightloom::passes;

PassType make_sharpen() {
  PassType type;
  type.name = "sharpen";
  type.doc = "Unsharp mask: adds to each pixel what it has more of than the mean around it.";
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "what to sharpen"),
                bypassed_by("radiance", image_output_like("radiance", Format::rgba32_sfloat, "radiance",
                                                          "the same, sharper; never below 0"))};
  type.params = {real_param("amount", 0.5, 0, 8, "", "how much of the difference is added"),
                 integer_param("radius", 2, 1, 16, "pixels", "half width of the square that the mean is over")};
  type.record = one_dispatch("sharpen.comp", "radiance");
  return type;
}

}  // namespace

LIGHTLOOM_PLUGIN("sharpen", "1.0", make_sharpen())
