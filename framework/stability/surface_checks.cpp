#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"
#include "framework/stability/rooms.hpp"

namespace lightloom::stability {
namespace {

constexpr uint32_t kBoard = 4;  ///< material of furnished_room's slanting board, which no other object has

/// The room with an image on its board, so that texture coordinates count.
scene::Scene room_with_image() {
  scene::Scene room = furnished_room();
  room.images.push_back({"grey", 2, 2, std::vector<uint8_t>(16, 200), true});
  room.materials[kBoard].base_color_texture.image = 0;
  room.features.textured = true;
  return room;
}

enum class Attribute : uint8_t { normal, tangent, texcoords };

/// One attribute of one corner of each of the board's triangles, all channels.
scene::Scene spoilt(scene::Scene scene, Attribute attribute, float value) {
  for (const scene::Triangle& triangle : scene.triangles) {
    if (triangle.material != kBoard) continue;
    scene::Vertex& vertex = scene.vertices[triangle.b];
    if (attribute == Attribute::normal) vertex.normal = glm::vec3(value);
    if (attribute == Attribute::tangent) vertex.tangent = glm::vec4(value);
    if (attribute == Attribute::texcoords) vertex.u0 = vertex.v0 = value;
  }
  return scene;
}

/// Voxels that differ, in which `clean` has the board (by its colour) or something else.
struct Voxels {
  double elsewhere = 0, board = 0;
};

Voxels compare_voxels(const Images& clean, const Images& damaged) {
  Voxels found;
  const image::HostImage& colors = clean.at("voxelize_static.voxels.albedo");
  const Extent3 extent = colors.desc.extent;
  for (uint32_t z = 0; z < extent.depth; ++z)
    for (uint32_t y = 0; y < extent.height; ++y)
      for (uint32_t x = 0; x < extent.width; ++x) {
        bool differs = false;
        for (const char* part : {"albedo", "normal", "material"})
          for (uint32_t channel = 0; channel < 4; ++channel) {
            const std::string name = std::string("voxelize_static.voxels.") + part;
            differs = differs || clean.at(name).at(x, y, z, channel) != damaged.at(name).at(x, y, z, channel);
          }
        const double red = colors.at(x, y, z, 0), green = colors.at(x, y, z, 1), blue = colors.at(x, y, z, 2);
        const bool board = red > 0 && red == green && blue < 0.7 * red;
        if (differs) ++(board ? found.board : found.elsewhere);
      }
  return found;
}

std::vector<Figure> measure_vertices(Lab& lab) {
  const scene::Scene room = room_with_image();
  RunOptions options = small_run(32, 24, 34);
  options.link.variants.clear();
  options.capture = {"voxelize_static.voxels.*"};
  RunOptions reference = small_run(24, 18, 34);
  reference.link.variants.clear();
  reference.link.sets = {{"paths", "2"}};
  const Images clean = lab.last_frame(lab.shipped_graph("lightloom"), room, options);
  std::vector<Figure> figures;
  for (const auto& [attribute, name] :
       {std::pair(Attribute::normal, "normal"), std::pair(Attribute::tangent, "tangent"),
        std::pair(Attribute::texcoords, "texture coordinates")}) {
    double bad = 0, bad_reference = 0, elsewhere = 0, board = 0;
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      const scene::Scene scene = spoilt(room, attribute, value);
      const Images shown = lab.last_frame(lab.shipped_graph("lightloom"), scene, options);
      bad += non_finite(shown.at("radiance"));
      const Voxels voxels = compare_voxels(clean, shown);
      elsewhere += voxels.elsewhere;
      board += voxels.board;
      // Texture coordinates that are no numbers end its run with an error that says so.
      if (attribute == Attribute::texcoords || !std::isnan(value)) continue;
      bad_reference += non_finite(lab.last_frame(lab.shipped_graph("reference"), scene, reference).at("radiance"));
    }
    figures.push_back(none(std::string(name) + ": values that are not finite", bad));
    if (attribute != Attribute::texcoords)
      figures.push_back(none(std::string(name) + ": the same by the reference, NaN alone", bad_reference));
    figures.push_back(none(std::string(name) + ": voxels that change, but those of that object", elsewhere));
    if (attribute == Attribute::normal)
      figures.push_back(none(std::string(name) + ": voxels of it that are not as by its triangles", board));
    else
      figures.push_back(at_least(std::string(name) + ": voxels of it that change", board, 1));
  }
  return figures;
}

}  // namespace

void add_surface_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "injected NaN");
  add("spoilt_vertices", "normals, tangents or texture coordinates of an object's corners are NaN or infinite",
      "voxels and G-buffer hold what is no number, and every path that meets them",
      "normals and tangents of the triangle in their place: shaders/lib/basis.glsl, safe_normalize; voxels hold "
      "fractions of 1 alone",
      measure_vertices);
}

}  // namespace lightloom::stability
