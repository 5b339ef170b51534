#include "tests/support/graph_runner.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "framework/base/diagnostics.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/compute_types.hpp"
#include "framework/run/executor.hpp"
#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

[[noreturn]] void fail(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) text += format_diagnostic(diagnostic) + "\n";
  throw std::runtime_error(text);
}

Plan compile_text(std::string_view graph_json, const PassRegistry& registry, const LinkOptions& options,
                  const scene::Scene& scene, const run::ShaderFolders& shaders) {
  Diagnostics diagnostics;
  std::optional<GraphSpec> spec = parse_graph(graph_json, "test.json", diagnostics);
  if (!spec) fail(diagnostics);
  run::make_compute_types(*spec, registry, shaders, diagnostics);
  const std::optional<Graph> graph = link(*spec, registry, options, run::link_environment(&scene), diagnostics);
  if (!graph) fail(diagnostics);
  return compile(*graph);
}

void add_quad(scene::Scene& target, const QuadSpec& quad) {
  const glm::vec3 normal = glm::normalize(glm::cross(quad.edge_u, quad.edge_v));
  const auto base = static_cast<uint32_t>(target.vertices.size());
  const auto object = static_cast<uint32_t>(target.objects.size());
  for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    scene::Vertex vertex;
    vertex.position = quad.corner + uv.x * quad.edge_u + uv.y * quad.edge_v;
    vertex.normal = normal;
    vertex.tangent = glm::vec4(glm::normalize(quad.edge_u), 1);
    vertex.u0 = uv.x;
    vertex.v0 = uv.y;
    target.vertices.push_back(vertex);
    target.bounds.min = glm::min(target.bounds.min, vertex.position);
    target.bounds.max = glm::max(target.bounds.max, vertex.position);
  }
  target.triangles.push_back({base, base + 1, base + 2, quad.material, object});
  target.triangles.push_back({base, base + 2, base + 3, quad.material, object});
  target.objects.push_back("quad " + std::to_string(object));
}

}  // namespace

void visit_frames(std::string_view graph_json, const scene::Scene& scene, const GraphRunOptions& options,
                  const FrameVisitor& visit) {
  PassRegistry registry;
  passes::register_builtin_passes(registry);
  for (const PassType& type : options.extra_types) registry.add(type);
  LinkOptions link_options = options.link;
  link_options.captures.insert(link_options.captures.end(), options.capture.begin(), options.capture.end());
  run::ShaderFolders shaders = run::default_shader_folders();
  shaders.sources.push_back(source_dir() / "tests/passes/shaders");
  run::Executor executor(shared_device(), compile_text(graph_json, registry, link_options, scene, shaders), scene,
                         {.shaders = shaders,
                          .camera = options.camera,
                          .seed = options.seed,
                          .frames_per_second = 30,
                          .frozen_time = options.frozen_time,
                          .share_memory = options.share_memory});
  for (uint32_t frame = 0; frame < options.frames; ++frame) {
    run::FrameResult result = executor.run_frame(frame);
    Images images;
    for (run::NamedImage& output : result.outputs) images.insert_or_assign(output.name, std::move(output.image));
    for (run::NamedImage& capture : result.captures) images.insert_or_assign(capture.name, std::move(capture.image));
    visit(frame, std::move(images));
  }
}

std::vector<Images> run_graph(std::string_view graph_json, const scene::Scene& scene, const GraphRunOptions& options) {
  std::vector<Images> frames;
  visit_frames(graph_json, scene, options, [&](uint32_t, Images images) { frames.push_back(std::move(images)); });
  return frames;
}

scene::Camera look_at(const glm::vec3& eye, const glm::vec3& target, float vertical_fov_radians, const glm::vec3& up) {
  scene::Camera camera;
  camera.name = "test";
  camera.world_from_camera = glm::inverse(glm::lookAtRH(eye, target, up));
  camera.vertical_fov = vertical_fov_radians;
  return camera;
}

scene::Scene make_quad_scene(const std::vector<QuadSpec>& quads, std::vector<scene::Material> materials,
                             const scene::Camera& camera) {
  scene::Scene made;
  made.file = "quads";
  if (materials.empty()) materials.push_back(white_lambertian());
  made.materials = std::move(materials);
  made.cameras = {camera};
  made.bounds = {quads.front().corner, quads.front().corner};
  for (const QuadSpec& quad : quads) add_quad(made, quad);
  made.static_vertex_count = static_cast<uint32_t>(made.vertices.size());
  made.static_triangle_count = static_cast<uint32_t>(made.triangles.size());
  made.features.specular = true;
  for (const scene::Material& material : made.materials) {
    made.features.emissive = made.features.emissive || material.emission != glm::vec3(0);
    made.features.metallic = made.features.metallic || material.metallic > 0;
    made.features.anisotropic = made.features.anisotropic || material.anisotropy_strength > 0;
  }
  return made;
}

scene::Material white_lambertian() {
  scene::Material material;
  material.metallic = 0;
  material.specular_factor = 0;
  material.double_sided = true;
  return material;
}

}  // namespace lightloom::test
