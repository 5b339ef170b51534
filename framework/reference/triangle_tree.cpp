#include "framework/reference/triangle_tree.hpp"

#include <embree3/rtcore.h>

#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace lightloom::reference {
namespace {

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw Error(ExitCode::run_failed, "Embree cannot build the reference tracer's acceleration structure (" +
                                        std::string(error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "error ") +
                                        (error == RTC_ERROR_OUT_OF_MEMORY ? "" : std::to_string(error)) + ")");
}

/// What a filter gets to know of its ray.
struct QueryContext : RTCIntersectContext {
  const SceneTriangles* triangles;
  const Materials* materials;
  const ViewQuery* view;
};

bool faces_away(const SceneTriangles& triangles, uint32_t index, const glm::vec3& direction) {
  const scene::Triangle& t = triangles.triangle(index);
  const glm::dvec3 a(triangles.vertex(t.a).position);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(triangles.vertex(t.b).position) - a, glm::dvec3(triangles.vertex(t.c).position) - a);
  return glm::dot(normal, glm::dvec3(direction)) > 0;
}

bool is_there(const QueryContext& query, const TrianglePoint& point, const glm::vec3& direction) {
  const SceneTriangles& triangles = *query.triangles;
  const uint32_t material = triangles.triangle(point.triangle).material;
  const Materials::Traits& traits = query.materials->traits(material);
  if (query.view != nullptr && !traits.double_sided && faces_away(triangles, point.triangle, direction)) return false;
  if (!traits.masked) return true;
  const TexturePoint where = query.view != nullptr
                                 ? triangles.texture_point(point, *query.view->camera, *query.view->ray)
                                 : triangles.texture_point(point);
  return !query.materials->cut_out(material, where, triangles.color(point));
}

/// Of masked triangles for all rays; of all triangles for those of the viewer. Embree calls it for one ray at a time.
void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *static_cast<const QueryContext*>(arguments->context);
  const auto& indices = *static_cast<const std::vector<uint32_t>*>(arguments->geometryUserPtr);
  const TrianglePoint point{indices[RTCHitN_primID(arguments->hit, 1, 0)], RTCHitN_u(arguments->hit, 1, 0),
                            RTCHitN_v(arguments->hit, 1, 0)};
  const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, 1, 0), RTCRayN_dir_y(arguments->ray, 1, 0),
                            RTCRayN_dir_z(arguments->ray, 1, 0));
  if (!is_there(query, point, direction)) arguments->valid[0] = 0;
}

QueryContext make_context(const SceneTriangles& triangles, const Materials& materials, const ViewQuery* view) {
  QueryContext context;
  rtcInitIntersectContext(&context);
  context.filter = view != nullptr ? filter : nullptr;
  context.triangles = &triangles;
  context.materials = &materials;
  context.view = view;
  return context;
}

void set_ray(RTCRay& target, const Ray& ray, float distance) {
  target.org_x = ray.origin.x;
  target.org_y = ray.origin.y;
  target.org_z = ray.origin.z;
  target.tnear = 0;
  target.dir_x = ray.direction.x;
  target.dir_y = ray.direction.y;
  target.dir_z = ray.direction.z;
  target.time = 0;
  target.tfar = distance;
  target.mask = 0xFFFFFFFFu;
  target.id = 0;
  target.flags = 0;
}

}  // namespace

struct TriangleTree::State {
  struct DeviceRelease {
    void operator()(RTCDevice held) const { rtcReleaseDevice(held); }
  };
  struct SceneRelease {
    void operator()(RTCScene held) const { rtcReleaseScene(held); }
  };
  using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
  using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

  Device device;
  Scene scene;
  std::vector<uint32_t> opaque, masked;  ///< triangles by Embree's primitive; geometry 0 is the opaque ones

  void attach(const SceneTriangles& triangles, std::vector<uint32_t>& indices, uint32_t id, bool filtered) const;
};

void TriangleTree::State::attach(const SceneTriangles& triangles, std::vector<uint32_t>& indices, uint32_t id,
                                 bool filtered) const {
  if (indices.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), indices.size() * 3));
  auto* order = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(uint32_t), indices.size()));
  if (corners != nullptr && order != nullptr) {
    for (const uint32_t index : indices) {
      const scene::Triangle& t = triangles.triangle(index);
      for (const uint32_t vertex : {t.a, t.b, t.c}) *corners++ = triangles.vertex(vertex).position;
    }
    for (uint32_t corner = 0; corner < indices.size() * 3; ++corner) *order++ = corner;
    rtcSetGeometryUserData(geometry, &indices);
    if (filtered) {
      rtcSetGeometryIntersectFilterFunction(geometry, filter);
      rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene.get(), geometry, id);
  }
  rtcReleaseGeometry(geometry);
}

TriangleTree::TriangleTree(const SceneTriangles& triangles, const Materials& materials, uint32_t first,
                           uint32_t count) {
  if (count == 0) return;
  state_ = std::make_unique<State>();
  for (uint32_t index = first; index < first + count; ++index)
    (materials.traits(triangles.triangle(index).material).masked ? state_->masked : state_->opaque).push_back(index);
  state_->device.reset(rtcNewDevice(nullptr));
  if (!state_->device) throw Error(ExitCode::run_failed, "Embree cannot be started on this processor");
  state_->scene.reset(rtcNewScene(state_->device.get()));
  rtcSetSceneFlags(state_->scene.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  state_->attach(triangles, state_->opaque, 0, false);
  state_->attach(triangles, state_->masked, 1, true);
  rtcCommitScene(state_->scene.get());
  check(state_->device.get());
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

void TriangleTree::intersect(const SceneTriangles& triangles, const Materials& materials, const Ray& ray,
                             const ViewQuery* view, TriangleHit& hit) const {
  if (!state_) return;
  QueryContext context = make_context(triangles, materials, view);
  RTCRayHit query;
  set_ray(query.ray, ray, hit.t);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
  const std::vector<uint32_t>& indices = query.hit.geomID == 0 ? state_->opaque : state_->masked;
  hit = {{indices[query.hit.primID], query.hit.u, query.hit.v}, query.ray.tfar};
}

bool TriangleTree::occluded(const SceneTriangles& triangles, const Materials& materials, const Ray& ray,
                            float distance) const {
  if (!state_) return false;
  QueryContext context = make_context(triangles, materials, nullptr);
  RTCRay query;
  set_ray(query, ray, distance);
  rtcOccluded1(state_->scene.get(), &context, &query);
  return query.tfar < 0;
}

}  // namespace lightloom::reference
