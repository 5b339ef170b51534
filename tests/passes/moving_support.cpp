#include "tests/passes/moving_support.hpp"

#include <algorithm>
#include <memory>

#include "framework/scene/source.hpp"

namespace lightloom::test {
namespace {

constexpr float kFrameSeconds = 1.0f / 30;

scene::Track make_track(int32_t node, scene::TrackPath path, size_t width, size_t frames) {
  scene::Track track;
  track.node = node;
  track.path = path;
  track.interpolation = scene::Interpolation::step;
  track.width = width;
  // Half a frame early, so that rounding cannot take the key before.
  for (size_t frame = 0; frame < frames; ++frame)
    track.times.push_back(std::max(static_cast<float>(frame) - 0.5f, 0.0f) * kFrameSeconds);
  return track;
}

scene::Clip make_clip(int32_t node, const std::vector<Placement>& placements) {
  scene::Track translation = make_track(node, scene::TrackPath::translation, 3, placements.size());
  scene::Track rotation = make_track(node, scene::TrackPath::rotation, 4, placements.size());
  scene::Track scale = make_track(node, scene::TrackPath::scale, 3, placements.size());
  for (const Placement& p : placements) {
    for (const float value : {p.translation.x, p.translation.y, p.translation.z}) translation.values.push_back(value);
    for (const float value : {p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w}) rotation.values.push_back(value);
    for (int axis = 0; axis < 3; ++axis) scale.values.push_back(p.scale);
  }
  return {{translation, rotation, scale}, static_cast<double>(placements.size()) * kFrameSeconds, 0};
}

}  // namespace

scene::Scene with_moving(scene::Scene scene, const std::vector<MovingObject>& objects) {
  auto source = std::make_shared<scene::SceneSource>();
  for (const MovingObject& object : objects) {
    const scene::Scene shape = make_triangle_scene(object.triangles, {object.material});
    auto primitive = std::make_shared<scene::Primitive>();
    primitive->vertices = shape.vertices;
    const auto node = static_cast<int32_t>(source->nodes.size());
    const auto material = static_cast<uint32_t>(scene.materials.size());
    const auto id = static_cast<uint32_t>(scene.objects.size());
    const auto base = static_cast<uint32_t>(scene.vertices.size());
    source->nodes.emplace_back();
    source->clips.push_back(make_clip(node, object.placements));
    scene::Draw draw;
    draw.primitive = primitive;
    draw.node = node;
    draw.material = material;
    draw.object = id;
    draw.first_vertex = base - scene.static_vertex_count;
    source->draws.push_back(draw);
    scene.materials.push_back(object.material);
    scene.objects.push_back("object " + std::to_string(id));
    scene.vertices.insert(scene.vertices.end(), shape.vertices.begin(), shape.vertices.end());
    for (const scene::Triangle& t : shape.triangles)
      scene.triangles.push_back({base + t.a, base + t.b, base + t.c, material, id});
  }
  scene.source = std::move(source);
  scene.features.dynamic = true;
  return scene;
}

}  // namespace lightloom::test
