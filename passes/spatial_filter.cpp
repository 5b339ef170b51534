#include "passes/spatial_filter.hpp"

#include <utility>

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

std::vector<Param> shape_params() {
  return {
      choice_param(
          "lobe", "both", {"both", "diffuse", "specular"},
          "which reflected light `radiance` is, and so the roughness that scales the filter: `diffuse` 1; `specular` "
          "the Ward alphas; `both` between them, by the fourth power of the specular share of the reflectance"),
      choice_param("kernel", "anisotropic", {"anisotropic", "isotropic"},
                   "`anisotropic`: the roughness along each axis; `isotropic`, for comparison: their geometric mean "
                   "along both, which covers the same area"),
      choice_param(
          "roughness", "alpha", {"alpha", "perceptual"},
          "what the roughness is measured by: Ward's alpha, or its square root, which is longer for glossy surfaces; "
          "with the default reach it is still a fraction of the width of their reflections of what is not close by"),
      real_param("floor_fraction", 0.0035, 0, 1, "scene diagonals",
                 "reach of the filter near the viewer, at roughness 1: half length and radial cut-off"),
      real_param("distance_fraction", 1.0 / 30.0, 0, 1, "distances from the viewer",
                 "reach of the filter far from the viewer, at roughness 1"),
      real_param("normal_threshold", 0.9, -1, 1, "", "smallest cosine between the normals"),
  };
}

std::vector<Param> guide_params() {
  return {
      real_param("variance_guide", 1.0, 0, 1, "",
                 "with `variance` connected, how far the half length may shrink where the radiance is known well: 0 "
                 "not at all, 1 to one pixel"),
      real_param("full_width_error", 0.25, 1e-6, 1e6, "",
                 "relative standard error of the radiance from which on the filter has its full length"),
      real_param("difference_limit", 3.0, 0, 1e6, "standard errors",
                 "with `variance` connected, neighbours whose luminance differs by more than this many standard errors "
                 "of the difference are left out: shadow edges stay; at least 5 where alpha, the frames behind a "
                 "pixel, is below 4; 0 turns it off"),
  };
}

}  // namespace

PassType make_spatial_filter(const std::string& name, std::string doc, std::vector<Param> own_params) {
  PassType type;
  type.name = name;
  type.doc = std::move(doc);
  Port radiance =
      image_output_like("radiance", Format::rgba32_sfloat, "radiance", "rgb: filtered radiance; a: as it came in");
  radiance.bypass = Bypass{"radiance", {}};
  Port variance = same_size_as(
      "radiance",
      image_input(
          "variance", Format::r32_sfloat,
          "estimated variance of the luminance of `radiance`; unconnected: the filter has its full length everywhere"));
  variance.optional = true;
  const Port guide = optional(same_size_as(
      "radiance", image_input("guide", Format::rgba32_uint,
                              "of `filter_guide`: neighbours are judged by it instead of by `surface` and `variance`, "
                              "which takes a quarter of the loads")));
  type.ports = {
      image_input("radiance", Format::rgba32_sfloat, "what to filter; a: frames behind it, 0 where there is nothing"),
      same_size_as("radiance", surface_input("surface", "G-buffer of the same pixels")), variance, guide, radiance};
  type.params = std::move(own_params);
  for (Param& param : shape_params()) type.params.push_back(std::move(param));
  for (Param& param : guide_params()) type.params.push_back(std::move(param));
  type.reads = FrameState::camera;
  type.record = [shader = name + ".comp"](PassContext& context) {
    context.dispatch({shader, context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
