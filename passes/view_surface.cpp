#include "passes/view_surface.hpp"

#include "framework/base/error.hpp"
#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

void record(PassContext& context) {
  if (context.params().choice("show") == "motion" && !context.connected("motion"))
    throw Error(ExitCode::invalid_input, "view_surface: show is 'motion', but its input 'motion' is not connected",
                "connect it to the port 'motion' of a gather pass");
  context.dispatch({"view_surface.comp", context.output_extent("image"), {}});
}

}  // namespace

PassType make_view_surface() {
  PassType type;
  type.name = "view_surface";
  type.doc = "A picture of one part of a G-buffer. The background is grey.";
  Port motion = same_size_as("surface", image_input("motion", Format::rg32_sfloat, "motion on the screen [pixels]"));
  motion.optional = true;
  type.ports = {surface_input("surface", "what to show"), motion,
                image_output_like("image", Format::rgba8_unorm, "surface", "sRGB-encoded colour; a: 1")};
  type.params = {
      choice_param("show", "albedo",
                   {"albedo", "normal", "geometric_normal", "tangent", "material", "emission", "object", "material_id",
                    "position", "depth", "motion"},
                   "`albedo`: base colour; `normal`, `geometric_normal`, `tangent`: direction / 2 + 1/2; `material`: "
                   "square roots of the Ward alphas, 4 F0; `emission`: L / (1 + L); `object`, `material_id`: a colour "
                   "for each; `position`: within the bounds of the scene; `depth`: D / (D + view depth), D an eighth "
                   "of the scene's diagonal; `motion`: m / (|m| + 8 pixels) / 2 + 1/2, x red, y green"),
  };
  type.reads = FrameState::none;
  type.record = record;
  return type;
}

}  // namespace lightloom::passes
