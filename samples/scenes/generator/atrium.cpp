#include "samples/scenes/generator/atrium.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "samples/scenes/generator/building.hpp"
#include "samples/scenes/generator/objects.hpp"

namespace lightloom::samples {

namespace {

using Json = GltfBuilder::Json;
constexpr double kPi = std::numbers::pi;

struct Materials {
  size_t tiles, brick, red, blue, stone, plaster, timber, iron, brass, gold, emerald, panel, clay, soil, frond, grille;
};

Json surface(const char* name, Json base_color, double metallic, double roughness) {
  base_color.push_back(1);
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", std::move(base_color)}, {"metallicFactor", metallic}, {"roughnessFactor", roughness}}}};
}

Json textured(const char* name, size_t texture, double roughness) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}, {"roughnessFactor", roughness}}}};
}

Json cut_out(Json material) {
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.5;
  material["doubleSided"] = true;
  return material;
}

Materials add_materials(GltfBuilder& gltf) {
  Json tiles = textured("tiles", gltf.add_texture("tiles.png", true), 1);
  tiles["pbrMetallicRoughness"]["metallicFactor"] = 1;  // the texture's blue channel says 0
  tiles["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", gltf.add_texture("tiles_surface.png", true)}};
  Json brick = textured("brick", gltf.add_texture("brick.png", true), 0.85);
  brick["normalTexture"] = {{"index", gltf.add_texture("brick_normal.png", true)}};
  // The tool marks run around the axis with the tangent; reflections spread across them, a quarter turn away.
  Json brass = surface("brushed brass", {0.91, 0.72, 0.40}, 1, 0.3);
  brass["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.8}, {"anisotropyRotation", kPi / 2}};
  Json panel = surface("panel", {0.05, 0.05, 0.05}, 0, 0.9);
  panel["emissiveFactor"] = {1, 0.76, 0.48};
  panel["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 9}};
  gltf.use_extension("KHR_materials_anisotropy");
  gltf.use_extension("KHR_materials_emissive_strength");

  Materials m{};
  m.tiles = gltf.add_material(std::move(tiles));
  m.brick = gltf.add_material(std::move(brick));
  m.red = gltf.add_material(surface("red wall", {0.70, 0.15, 0.08}, 0, 0.9));
  m.blue = gltf.add_material(surface("blue wall", {0.08, 0.25, 0.55}, 0, 0.9));
  m.stone = gltf.add_material(surface("stone", {0.72, 0.66, 0.56}, 0, 0.5));
  m.plaster = gltf.add_material(surface("plaster", {0.80, 0.78, 0.74}, 0, 0.95));
  m.timber = gltf.add_material(surface("timber", {0.30, 0.18, 0.10}, 0, 0.6));
  m.iron = gltf.add_material(surface("iron", {0.12, 0.12, 0.12}, 1, 0.45));
  m.brass = gltf.add_material(std::move(brass));
  m.gold = gltf.add_material(surface("gold", {1.0, 0.77, 0.34}, 1, 0.25));
  m.emerald = gltf.add_material(surface("emerald", {0.04, 0.48, 0.26}, 0, 0.15));
  m.panel = gltf.add_material(std::move(panel));
  m.clay = gltf.add_material(surface("clay", {0.55, 0.24, 0.13}, 0, 0.7));
  m.soil = gltf.add_material(surface("soil", {0.07, 0.05, 0.04}, 0, 1));
  m.frond = gltf.add_material(cut_out(textured("frond", gltf.add_texture("frond.png", false), 0.6)));
  m.grille = gltf.add_material(cut_out(textured("grille", gltf.add_texture("grille.png", true), 0.5)));
  return m;
}

size_t add_solid(GltfBuilder& gltf, const std::string& name, const Mesh& mesh, size_t material) {
  return gltf.add_mesh(name, std::vector<Primitive>{{mesh, material}});
}

void add_shell(GltfBuilder& gltf, const Materials& m) {
  const auto place = [&](const char* name, const Mesh& mesh, size_t material) {
    gltf.add_root(gltf.add_node({.name = name, .mesh = add_solid(gltf, name, mesh, material)}));
  };
  place("floor", floor_slab(), m.tiles);
  place("roof", roof_slab(), m.plaster);
  place("end walls", end_walls(), m.brick);
  place("beams", beams(), m.timber);
}

/// Both colonnades: the same meshes, the second turned by half a turn.
void add_sides(GltfBuilder& gltf, const Materials& m) {
  const size_t column_mesh = add_solid(gltf, "column", column(), m.stone);
  const size_t arcade_mesh = add_solid(gltf, "arcade", arcade(), m.stone);
  const std::vector<Primitive> gallery{
      {gallery_slab(), m.plaster}, {gallery_handrail(), m.iron}, {gallery_grille(), m.grille}};
  const size_t gallery_mesh = gltf.add_mesh("gallery", gallery);
  const auto add_side = [&](const std::string& name, size_t wall_material, std::array<double, 4> rotation) {
    Node side{.name = name + " side", .rotation = rotation};
    const size_t wall = add_solid(gltf, name + " wall", side_wall(), wall_material);
    side.children.push_back(gltf.add_node({.name = name + " wall", .mesh = wall}));
    side.children.push_back(gltf.add_node({.name = name + " gallery", .mesh = gallery_mesh}));
    side.children.push_back(
        gltf.add_node({.name = name + " arcade", .mesh = arcade_mesh, .translation = {0, 0, kArcade}}));
    for (int i = 0; i < 4; ++i) {
      side.children.push_back(gltf.add_node({.name = name + " column " + std::to_string(i + 1),
                                             .mesh = column_mesh,
                                             .translation = {(i - 1.5) * kBay, 0, kArcade}}));
    }
    gltf.add_root(gltf.add_node(side));
  };
  add_side("red", m.red, {0, 0, 0, 1});
  add_side("blue", m.blue, {0, 1, 0, 0});
}

void add_furniture(GltfBuilder& gltf, const Materials& m) {
  const auto place = [&](const char* name, size_t mesh, glm::dvec3 position) {
    gltf.add_root(gltf.add_node({.name = name, .mesh = mesh, .translation = position}));
  };
  place("urn plinth", add_solid(gltf, "urn plinth", plinth(0.36, 0.42), m.stone), {0.55, 0, 0.8});
  place("urn", add_solid(gltf, "urn", urn(), m.brass), {0.55, 0.42, 0.8});
  place("gem plinth", add_solid(gltf, "gem plinth", plinth(0.27, 0.85), m.stone), {-1.3, 0, 0.3});
  const std::vector<Primitive> plant{{pot(), m.clay}, {pot_soil(), m.soil}, {fronds(), m.frond}};
  place("plant", gltf.add_mesh("plant", plant), {1.3, 0, -1.6});
  const std::vector<Primitive> lamp{{lamp_housing(0.26, 1.3), m.iron}, {lamp_panel(0.26, 1.3), m.panel}};
  const size_t lamp_mesh = gltf.add_mesh("lamp", lamp);
  place("nave lamp", lamp_mesh, {-kHalfLength, 1.1, -1.5});
  place("aisle lamp", lamp_mesh, {-kHalfLength, 1.1, -3.15});
}

/// A gem in a ring that turns once and bobs once in 4 s, so that the loop closes.
void add_mobile(GltfBuilder& gltf, const Materials& m) {
  constexpr int kSteps = 16;
  const glm::dvec3 rest(-1.3, 1.55, 0.3);
  const std::vector<Primitive> primitives{{gem(), m.emerald}, {gem_ring(), m.gold}};
  const size_t node =
      gltf.add_node({.name = "mobile", .mesh = gltf.add_mesh("mobile", primitives), .translation = rest});
  gltf.add_root(node);
  std::vector<double> times;
  Channel rotation{node, "rotation", {}}, translation{node, "translation", {}};
  for (int i = 0; i <= kSteps; ++i) {
    const double phase = static_cast<double>(i) / kSteps;
    times.push_back(4 * phase);
    rotation.values.insert(rotation.values.end(), {0, std::sin(kPi * phase), 0, std::cos(kPi * phase)});
    translation.values.insert(translation.values.end(), {rest.x, rest.y + 0.15 * std::sin(2 * kPi * phase), rest.z});
  }
  gltf.add_animation("turn and bob", times, std::vector<Channel>{rotation, translation});
}

void add_gallery_camera(GltfBuilder& gltf) {
  const glm::dvec3 eye(5.0, 4.9, -3.0), target(-1.2, 1.0, 0.9);
  const glm::dquat turn = glm::quatLookAtRH(glm::normalize(target - eye), glm::dvec3(0, 1, 0));
  gltf.add_root(gltf.add_node({.name = "gallery",
                               .camera = gltf.add_camera("gallery", 62 * kPi / 180),
                               .translation = eye,
                               .rotation = {turn.x, turn.y, turn.z, turn.w}}));
}

}  // namespace

GltfBuilder build_atrium() {
  GltfBuilder gltf;
  const Materials materials = add_materials(gltf);
  add_shell(gltf, materials);
  add_sides(gltf, materials);
  add_furniture(gltf, materials);
  add_mobile(gltf, materials);
  add_gallery_camera(gltf);
  return gltf;
}

}  // namespace lightloom::samples
