#include "tests/passes/light_support.hpp"

#include <sstream>

#include "passes/port_rows.hpp"

namespace lightloom::test {

PassType make_pattern() {
  PassType type;
  type.name = "pattern";
  type.doc = "A known image.";
  type.ports = {passes::surface_input("surface", "gives the size and the patterns that follow it"),
                passes::image_output_like("radiance", Format::rgba32_sfloat, "surface", "the pattern")};
  type.params = {
      {"pattern",
       ParamType::choice,
       std::string("constant"),
       {},
       {},
       {"constant", "noise", "impulse", "normal", "object", "ramp", "frame", "spoilt", "bump", "step", "texture"},
       "",
       "which"},
      {"scale", ParamType::real, 1.0, {}, {}, {}, "", "factor on it"}};
  type.reads = FrameState::time | FrameState::seed | FrameState::camera;
  type.record = [](PassContext& context) { context.dispatch({"pattern.comp", context.output_extent("radiance"), {}}); };
  return type;
}

std::string graph_text(uint32_t view_width, uint32_t view_height, uint32_t trace_width, uint32_t trace_height,
                       const std::string& passes, const std::string& outputs) {
  std::ostringstream text;
  text << R"({ "lightloom": 1, "name": "test", "view": { "width": )" << view_width << R"(, "height": )" << view_height
       << R"( }, "trace": { "width": )" << trace_width << R"(, "height": )" << trace_height << R"( }, "passes": { )"
       << passes << R"( }, "outputs": { )" << outputs << " } }";
  return text.str();
}

scene::Material lambertian(const glm::vec3& base_color) {
  scene::Material material;
  material.base_color = glm::vec4(base_color, 1);
  material.metallic = 0;
  material.specular_factor = 0;
  return material;
}

double mean_of(const image::HostImage& image, uint32_t channel, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1) {
  double sum = 0, count = 0;
  for (uint32_t y = y0; y < y1; ++y)
    for (uint32_t x = x0; x < x1; ++x) {
      if (image.at(x, y, 0, 3) <= 0) continue;
      sum += image.at(x, y, 0, channel);
      ++count;
    }
  return sum / count;
}

std::string trace_passes(int resolution, const std::string& extra, const std::string& inputs) {
  return R"("voxelize": { "type": "voxelize", "params": { "geometry": "all", "resolution": )" +
         std::to_string(resolution) + R"( } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" },
    "trace": { "type": "voxel_path_trace", "in": { "surface": "gather.surface", "voxels": "voxelize.voxels",
               "distance": "distance.distance")" +
         inputs + R"( }, "params": { )" + extra + " } }";
}

}  // namespace lightloom::test
