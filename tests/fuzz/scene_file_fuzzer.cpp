// Scene files: bytes that begin as GLB are tried as .glb, text that speaks of lightloom_scene as *.scene.json, all else
// as .gltf. Each must load or be refused by an Error; a scene that loads must be sound.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/scene/camera_path.hpp"
#include "framework/scene/content_hash.hpp"
#include "framework/scene/load_options.hpp"
#include "framework/scene/texture_pages.hpp"
#include "tests/fuzz/private_folder.hpp"
#include "tests/support/source_dir.hpp"

namespace {

using namespace lightloom;

scene::LoadOptions small_limits() {
  scene::LoadOptions options;
  Limits& limits = options.limits;
  limits.file_bytes = limits.total_bytes = limits.json_bytes = 1 << 22;
  limits.json_values = 100'000;
  limits.elements = limits.nodes = 2000;
  limits.vertices = limits.triangles = 20'000;
  limits.accessor_values = limits.animation_values = limits.morph_weights = limits.joints = 100'000;
  limits.posed_elements = 1'000'000;
  limits.image_texels = limits.texture_texels = limits.float_texels = limits.page_texels = 1 << 18;
  return options;
}

void require(bool sound) {
  if (!sound) std::abort();
}

void require_sound(const scene::Scene& scene) {
  for (const scene::Triangle& triangle : scene.triangles) {
    require(std::max({triangle.a, triangle.b, triangle.c}) < scene.vertices.size());
    require(triangle.material < scene.materials.size() && triangle.object < scene.objects.size());
  }
  for (const scene::Vertex& vertex : scene.vertices) require(std::isfinite(glm::dot(vertex.position, vertex.normal)));
  require(!scene.triangles.empty() && !scene.cameras.empty());
  static_cast<void>(scene::pose(scene, 0.3));
  static_cast<void>(scene::build_texture_pages(scene));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fuzz::PrivateFolder folder;
  static const std::filesystem::path model = [] {
    const std::string text = read_text_file(source_dir() / "tests/fuzz/corpus/scene_file/quad.gltf");
    return folder.write("quad.gltf", {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  }();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bool binary = text.starts_with("glTF"), scene_file = text.find("lightloom_scene") != std::string_view::npos,
             path = text.find("lightloom_camera_path") != std::string_view::npos;
  const std::filesystem::path file = folder.write(binary               ? "a.glb"
                                                  : scene_file || path ? "a.scene.json"
                                                                       : "a.gltf",
                                                  {data, size});
  const scene::LoadOptions options = small_limits();
  try {
    static_cast<void>(scene::content_files(file, options));
    if (path)
      static_cast<void>(scene::camera_on_path(scene::read_camera_path(file, options.limits), 0.5, scene::Camera()));
    else
      require_sound(scene::load_scene(file, options));
  } catch (const Error& error) {
    require(error.code() == ExitCode::invalid_input && std::string_view(error.what()).size() > 10);
  }
  return 0;
}
