#include "passes/reservoir_rows.hpp"

#include <cstdint>

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {

std::vector<Port> reservoir_inputs() {
  return {surface_input("surface", "first hits"), voxels_input("voxels", "the grid that the tracer marches through"),
          image_input("faces", Format::rg32_uint, "emissive_faces.faces"),
          optional(image_input("power", Format::r32_uint, "emissive_faces.power, for `emitter_area` surface"))};
}

Port reservoir_output() {
  Port port = image_output_like(
      "reservoir", Format::rgba32_uint, "surface",
      "r: face, coded as in emissive_faces.faces; g: where on it along the two other axes, twice 16 bits; b: bits of "
      "the float that takes the place of 1 / pdf of the sample [faces], 0 where there is none; a: bits of the float "
      "that counts the frames whose candidates it was chosen from, 0 where there is no lit surface");
  port.exact_format = "it holds the bits of floats";
  port.bypass = Bypass{};
  return port;
}

Port reservoir_input(const std::string& name, const std::string& doc) {
  return same_size_as("surface", image_input(name, Format::rgba32_uint, doc));
}

std::vector<Param> with_share_params(const std::vector<Param>& own) {
  std::vector<Param> params = own;
  const std::vector<Param> shares = {
      choice_param("start", "clearance", {"clearance", "sqrt3"},
                   "where rays start, as in voxel_path_trace; it must be the same there"),
      choice_param("emitter_area", "voxels", {"voxels", "surface"},
                   "radiance of emissive voxels, as in voxel_path_trace; another one there costs noise, no more"),
      choice_param("strategy", "mis", {"mis", "nee", "bsdf"},
                   "who finds light, as in voxel_path_trace; with bsdf there are no samples"),
      choice_param("heuristic", "balance", {"balance", "power"},
                   "how light is shared, as in voxel_path_trace; another one there costs noise, no more"),
      real_param("reservoir_draws", 1, 1, 1e6, "",
                 "share of the sample, as in voxel_path_trace; another one there costs noise, no more"),
      choice_param("ward", "bounded", {"1992", "dur", "bounded"},
                   "form of the Ward lobe, as in voxel_path_trace; another one there costs noise, no more"),
  };
  params.insert(params.end(), shares.begin(), shares.end());
  return params;
}

void dispatch_reservoirs(PassContext& context, const std::string& shader) {
  // Lobes are evaluated, none is drawn from.
  context.dispatch({shader, context.output_extent("reservoir"), {{"ward_sampling", uint32_t{0}}}});
}

}  // namespace lightloom::passes
