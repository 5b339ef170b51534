#include <algorithm>
#include <cmath>
#include <string>

#include "framework/stability/check.hpp"
#include "framework/stability/differences.hpp"
#include "framework/stability/rooms.hpp"

namespace lightloom::stability {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 48;
constexpr uint32_t kResolution = 34;
constexpr float kVoxel = 0.125f;  ///< of furnished_room at that resolution [m]

RunOptions run_with_voxels(uint32_t paths) {
  RunOptions options = small_run(kWidth, kHeight, kResolution);
  options.link.sets.emplace_back("paths", std::to_string(paths));
  options.capture = {"voxelize_static.voxels.*"};
  return options;
}

Images shown(Lab& lab, const scene::Scene& scene, uint32_t paths = 1) {
  return lab.last_frame(lab.shipped_graph("lightloom"), scene, run_with_voxels(paths));
}

double differing_voxels(const Images& a, const Images& b) {
  double differing = 0;
  for (const char* part : {"albedo", "normal", "material"}) {
    const std::string name = std::string("voxelize_static.voxels.") + part;
    differing += differing_texels(a.at(name), b.at(name));
  }
  return differing;
}

std::vector<Figure> measure_translation(Lab& lab) {
  const scene::Scene room = furnished_room();
  const Images at_home = shown(lab, room);
  std::vector<Figure> figures;
  for (const glm::vec3 voxels : {glm::vec3(1, 0, 0), glm::vec3(-3, 7, 12), glm::vec3(-40, 0, 33)}) {
    const Images moved = shown(lab, placed(room, {.shift = voxels * kVoxel}));
    const std::string by = ", moved by " + std::to_string(static_cast<int>(voxels.x)) + ", " +
                           std::to_string(static_cast<int>(voxels.y)) + ", " +
                           std::to_string(static_cast<int>(voxels.z)) + " voxels";
    figures.push_back(none("voxels with other bits" + by, differing_voxels(at_home, moved)));
    figures.push_back(
        at_least("PSNR" + by, peak_signal_to_noise(at_home.at("radiance"), moved.at("radiance")), 60, "dB"));
  }
  return figures;
}

/// Voxels whose albedo is not that of the voxel that `turn`, a signed permutation of the axes, brings them from.
double not_permuted(const image::HostImage& before, const image::HostImage& after, const glm::mat3& turn) {
  const Extent3& extent = before.desc.extent;
  const glm::ivec3 size(extent.width, extent.height, extent.depth);
  const glm::ivec3 turned_size(glm::abs(turn * glm::vec3(size)));
  if (after.desc.extent != Extent3{static_cast<uint32_t>(turned_size.x), static_cast<uint32_t>(turned_size.y),
                                   static_cast<uint32_t>(turned_size.z)})
    return INFINITY;
  double count = 0;
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        // Centres of voxels about the middle of the grid, which stays.
        const glm::vec3 from = glm::vec3(x, y, z) + 0.5f - 0.5f * glm::vec3(size);
        const glm::uvec3 to(glm::round(turn * from + 0.5f * glm::vec3(turned_size) - 0.5f));
        bool same = true;
        for (uint32_t channel = 0; channel < 4; ++channel)
          same = same && before.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(z),
                                   channel) == after.at(to.x, to.y, to.z, channel);
        count += same ? 0 : 1;
      }
  return count;
}

struct Turn {
  std::string name;
  glm::mat3 matrix;
};

std::vector<Turn> right_turns() {
  const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{"a quarter turn about x", {x, z, -y}}, {"a quarter turn about y", {-z, y, x}},
          {"a quarter turn about z", {y, -x, z}}, {"a mirror along x", {-x, y, z}},
          {"a mirror along y", {x, -y, z}},       {"a mirror along z", {x, y, -z}}};
}

std::vector<Figure> measure_turns(Lab& lab) {
  constexpr uint32_t kPaths = 64;
  const scene::Scene room = furnished_room();
  const Images at_home = shown(lab, room, kPaths);
  const Mean expected = mean_of(at_home.at("radiance"));
  std::vector<Figure> figures;
  for (const Turn& turn : right_turns()) {
    const Images turned = shown(lab, placed(room, {.turn = turn.matrix}), kPaths);
    figures.push_back(none("voxels not permuted, " + turn.name,
                           not_permuted(at_home.at("voxelize_static.voxels.albedo"),
                                        turned.at("voxelize_static.voxels.albedo"), turn.matrix)));
    const Mean mean = mean_of(turned.at("radiance"));
    figures.push_back(
        at_most("change of the mean, " + turn.name, std::abs(mean.value / expected.value - 1), 0.01, "relative"));
  }
  return figures;
}

std::vector<Figure> measure_outsider(Lab& lab) {
  const scene::Scene room = furnished_room();
  const Images alone = shown(lab, room);
  scene::Scene more = room;
  const scene::Scene outside = make_quad_scene({{{100, -1, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, room.cameras.front());
  const auto base = static_cast<uint32_t>(more.vertices.size());
  more.vertices.insert(more.vertices.end(), outside.vertices.begin(), outside.vertices.end());
  for (scene::Triangle triangle : outside.triangles) {
    triangle.a += base;
    triangle.b += base;
    triangle.c += base;
    triangle.object = static_cast<uint32_t>(more.objects.size());
    more.triangles.push_back(triangle);
  }
  more.objects.emplace_back("outsider");
  more.static_vertex_count = static_cast<uint32_t>(more.vertices.size());
  more.static_triangle_count = static_cast<uint32_t>(more.triangles.size());
  // The bounds stay: a grid around what matters, and an object that is neither in it nor in the picture.
  const Images with = shown(lab, more);
  return {none("voxels with other bits", differing_voxels(alone, with)),
          none("pixels with other bits", differing_texels(alone.at("radiance"), with.at("radiance")))};
}

/// Boards that share no voxel, of several colours, one of them a lamp, under a faint sky.
scene::Scene loose_boards() {
  std::vector<scene::Material> materials(5, white_lambertian());
  for (size_t i = 0; i < materials.size(); ++i)
    materials[i].base_color = glm::vec4(0.15f * static_cast<float>(i), 0.4f, 0.5f, 1);
  materials[4].emission = glm::vec3(5);
  std::vector<QuadSpec> quads;
  for (uint32_t i = 0; i < 9; ++i)
    quads.push_back({{-1.75f + 1.25f * static_cast<float>(i % 3), -1.0f + 0.25f * static_cast<float>(i % 2),
                      -1.75f + 1.25f * static_cast<float>(i / 3)},
                     {0.75f, 0.25f, 0},
                     {0, 0.5f, 0.75f},
                     i % 5});
  scene::Scene scene = make_quad_scene(quads, materials, look_at({1, 2.5f, 3}, {0, -0.75f, 0}, 1));
  scene.environment.radiance = glm::vec3(0.1f);
  scene.features.environment = true;
  return scene;
}

std::vector<Figure> measure_order(Lab& lab) {
  const scene::Scene boards = loose_boards();
  const Images before = shown(lab, boards);
  scene::Scene other = boards;
  // Objects in another order, the triangles of each as they were: within a voxel the last one counts, by design.
  std::stable_sort(
      other.triangles.begin(), other.triangles.end(),
      [](const scene::Triangle& a, const scene::Triangle& b) { return a.object * 4 % 9 < b.object * 4 % 9; });
  const Images after = shown(lab, other);
  return {none("voxels with other bits", differing_voxels(before, after)),
          none("pixels with other bits", differing_texels(before.at("radiance"), after.at("radiance")))};
}

}  // namespace

void add_metamorphic_checks(std::vector<Check>& checks) {
  checks.push_back({.name = "moved_by_voxels",
                    .group = "metamorphic",
                    .extreme = "the scene moved by whole numbers of voxels",
                    .danger = "an origin that shows in the picture",
                    .guard = "the grid hangs on the scene's bounds: shaders/lib/grid.glsl",
                    .measure = measure_translation});
  checks.push_back({.name = "turned_and_mirrored",
                    .group = "metamorphic",
                    .extreme = "the scene turned by 90 degrees about each axis, and mirrored along each",
                    .danger = "an axis or a side that is treated unlike the others",
                    .guard = "the test of a voxel is symmetric in the axes: shaders/lib/supercover.glsl",
                    .measure = measure_turns});
  checks.push_back({.name = "outsider",
                    .group = "metamorphic",
                    .extreme = "an object outside the picture and the grid",
                    .danger = "indices that wrap around, random numbers that depend on the scene's size",
                    .guard = "boxes are clamped to the grid: shaders/lib/supercover.glsl",
                    .measure = measure_outsider});
  checks.push_back({.name = "order_of_objects",
                    .group = "metamorphic",
                    .extreme = "objects that share no voxel, in another order",
                    .danger = "results that depend on the order of threads",
                    .guard = "one atomic maximum a voxel: shaders/voxelize_claim.comp",
                    .measure = measure_order});
}

}  // namespace lightloom::stability
