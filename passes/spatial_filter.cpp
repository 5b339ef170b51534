#include "passes/spatial_filter.hpp"

#include <utility>

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

std::vector<Param> rejection_params() {
  return {
      {"floor_fraction",
       ParamType::real,
       0.0035,
       0,
       1,
       {},
       "scene diagonals",
       "reach of the filter near the viewer, at roughness 1: half length and radial cut-off"},
      {"distance_fraction",
       ParamType::real,
       1.0 / 30.0,
       0,
       1,
       {},
       "distances from the viewer",
       "reach of the filter far from the viewer, at roughness 1"},
      {"normal_threshold", ParamType::real, 0.9, -1, 1, {}, "", "smallest cosine between the normals"},
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
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "what to filter"),
                same_size_as("radiance", surface_input("surface", "G-buffer of the same pixels")), radiance};
  type.params = std::move(own_params);
  for (Param& param : rejection_params()) type.params.push_back(std::move(param));
  type.reads = FrameState::camera;
  type.record = [shader = name + ".comp"](PassContext& context) {
    context.dispatch({shader, context.output_extent("radiance"), {}});
  };
  return type;
}

}  // namespace lightloom::passes
