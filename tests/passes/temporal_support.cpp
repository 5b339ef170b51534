#include "tests/passes/temporal_support.hpp"

#include <algorithm>

#include "passes/port_rows.hpp"

namespace lightloom::test {
namespace {

double weight(int age, double roughness) {
  if (age == 0) return 1;
  if (roughness <= 0) return 0;
  const double x = std::clamp(1 - age / 10.0 * (1 - roughness) / roughness, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

}  // namespace

PassType make_test_displace() {
  PassType type;
  type.name = "test_displace";
  type.doc = "Positions that are wrong in odd frames.";
  type.ports = {passes::surface_input("surface", "where the positions come from"),
                passes::image_output_like("position", Format::rgba32_sfloat, "surface", "moved in odd frames")};
  type.reads = FrameState::time;
  type.record = [](PassContext& context) {
    context.dispatch({"test_displace.comp", context.output_extent("position"), {}});
  };
  return type;
}

scene::Scene wall(const scene::Material& material) {
  return make_quad_scene({{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}}, {material}, look_at({0.3f, 0.2f, 3}, {0, 0, 0}, 0.8f));
}

scene::Material metal(float roughness) {
  scene::Material material;
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

std::string temporal_graph(const std::string& pattern, const std::string& params, const std::string& position,
                           bool packed) {
  const std::string type = packed ? "temporal_accumulate_packed" : "temporal_accumulate";
  const std::string trails = packed ? R"("trail_point": "packed.point@1..9")"
                                    : R"("trail_position": ")" + position +
                                          R"(@1..9", "trail_normal": "gather.surface.normal@1..9",
      "trail_id": "gather.surface.id@1..9")";
  const std::string passes = R"("gather": { "type": "gather" },
    "pattern": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")" +
                             pattern + R"(" } },
    "moved": { "type": "test_displace", "in": { "surface": "gather.surface" } },
    "packed": { "type": "pack_surface", "in": { "surface": "gather.surface" } },
    "temporal": { "type": ")" +
                             type + R"(", "in": { "radiance": "pattern.radiance", "surface": "gather.surface",
      "trail": "pattern.radiance@1..9", )" +
                             trails + R"( }, "params": { )" + params + " } }";
  return graph_text(
      kTemporalSize, kTemporalSize, kTemporalSize, kTemporalSize, passes,
      R"("radiance": "temporal.radiance", "current": "pattern.radiance", "variance": "temporal.variance")");
}

std::vector<Images> run_temporal(const scene::Scene& scene, const std::string& graph, uint32_t frames,
                                 const LinkOptions& link) {
  GraphRunOptions options;
  options.frames = frames;
  options.link = link;
  options.extra_types = {make_pattern(), make_test_displace()};
  return run_graph(graph, scene, options);
}

double variance_of(const image::HostImage& image, uint32_t channel) {
  double sum = 0, squares = 0;
  const Extent3 extent = image.desc.extent;
  for (uint32_t y = 0; y < extent.height; ++y)
    for (uint32_t x = 0; x < extent.width; ++x) {
      const double value = image.at(x, y, 0, channel);
      sum += value;
      squares += value * value;
    }
  const double n = double{1} * extent.width * extent.height;
  return squares / n - sum / n * (sum / n);
}

double weight_sum(double roughness) {
  double sum = 0;
  for (int age = 0; age < 10; ++age) sum += weight(age, roughness);
  return sum;
}

double effective_frames(double roughness) {
  double squares = 0;
  for (int age = 0; age < 10; ++age) squares += weight(age, roughness) * weight(age, roughness);
  return weight_sum(roughness) * weight_sum(roughness) / squares;
}

}  // namespace lightloom::test
