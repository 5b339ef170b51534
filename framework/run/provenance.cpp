#include "framework/run/provenance.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "framework/base/hash.hpp"

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const ParamValue& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

Json remarks(const std::vector<PassRemark>& list) {
  Json result = Json::array();
  for (const PassRemark& remark : list) result.push_back({{"pass", remark.pass}, {"reason", remark.reason}});
  return result;
}

template <int N, typename T>
Json vector_json(const glm::vec<N, T>& vector) {
  Json result = Json::array();
  for (int i = 0; i < N; ++i) result.push_back(vector[i]);
  return result;
}

Json bounds_json(const scene::Bounds& bounds) {
  return {{"min", vector_json(bounds.min)}, {"max", vector_json(bounds.max)}};
}

Json key_json(const scene::CameraKey& key) {
  Json result = {{"time", key.time}, {"position", vector_json(key.position)}};
  if (const auto* target = std::get_if<glm::dvec3>(&key.aim)) {
    result["target"] = vector_json(*target);
  } else {
    const auto& turn = std::get<glm::dquat>(key.aim);
    result["rotation"] = {turn.x, turn.y, turn.z, turn.w};
  }
  if (key.vertical_fov) result["vertical_fov_degrees"] = glm::degrees(*key.vertical_fov);
  return result;
}

/// As an edge of a graph file: "pass.port.part", with "@k" or "@a..b" for earlier frames.
std::string source_text(const Graph& graph, const Use& use) {
  std::string text = value_name(graph.values[use.value]);
  if (use.last_age > 0) text += "@" + std::to_string(use.first_age);
  if (use.last_age > use.first_age) text += ".." + std::to_string(use.last_age);
  return text;
}

Json pass_record(const Graph& graph, const GraphPass& pass) {
  Json params = Json::object();
  for (const ParamSet::Entry& entry : pass.params.entries()) params[entry.param->name] = to_json(entry.value);
  Json inputs = Json::object();
  for (const Use& use : pass.inputs)
    inputs[use.part.empty() ? use.port : use.port + "." + use.part] = source_text(graph, use);
  return {{"pass", pass.name},
          {"type", pass.type->name},
          {"version", pass.type->version},
          {"inputs", inputs},
          {"params", params}};
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Json device_record(const gpu::DeviceInfo& info) {
  return {{"name", info.name},
          {"type", gpu::to_string(info.type)},
          {"driver", info.driver},
          {"driver_info", info.driver_info},
          {"api_version", info.api_version_text()},
          {"ray_queries", info.ray_query.available},
          {"uuid", info.uuid_text()}};
}

Json plugin_records(const std::vector<LoadedPlugin>& plugins) {
  Json records = Json::array();
  for (const LoadedPlugin& plugin : plugins)
    records.push_back({{"file", plugin.file.generic_string()}, {"name", plugin.name}, {"version", plugin.version}});
  return records;
}

Json scene_record(const scene::Scene& scene) {
  Json features = Json::object();
  for (const auto& [name, present] : scene.features.named()) features[name] = present;
  return {{"file", scene.file.generic_string()},
          {"triangles", scene.triangles.size()},
          {"static_triangles", scene.static_triangle_count},
          {"vertices", scene.vertices.size()},
          {"materials", scene.materials.size()},
          {"images", scene.images.size()},
          {"origin", vector_json(scene.origin)},
          {"bounds", bounds_json(scene.bounds)},
          {"features", features}};
}

Json camera_path_record(const std::optional<scene::CameraPath>& path) {
  if (!path) return nullptr;
  Json keys = Json::array();
  for (const scene::CameraKey& key : path->keys) keys.push_back(key_json(key));
  return {{"file", path->file.generic_string()},
          {"interpolation", to_string(path->interpolation)},
          {"up", vector_json(path->up)},
          {"keyframes", keys}};
}

Json frame_record(const FrameResult& frame, uint32_t seed, const scene::Scene& scene) {
  const glm::mat4 rows = glm::transpose(frame.conditions.view.view_projection);
  return {{"frame", frame.frame},
          {"time", frame.conditions.time},
          {"seed", seed},
          {"history_length", frame.conditions.history_length},
          {"view_projection", {vector_json(rows[0]), vector_json(rows[1]), vector_json(rows[2]), vector_json(rows[3])}},
          {"eye", vector_json(frame.conditions.view.eye)},
          {"scene_bounds", bounds_json(scene.bounds)},
          {"scene_origin", vector_json(scene.origin)}};
}

Json graph_record(const Plan& plan) {
  const Graph& graph = plan.graph;
  Json params = Json::object();
  for (const auto& [name, value] : graph.params) params[name] = to_json(value);
  Json outputs = Json::object();
  for (const GraphOutput& output : graph.outputs) outputs[output.name] = value_name(graph.values[output.value]);
  const MemoryUse memory = memory_use(graph);
  return {{"name", graph.name},
          {"plan_hash", hex(plan_hash(plan))},
          {"general", graph.general},
          {"view", {{"width", graph.view.width}, {"height", graph.view.height}}},
          {"trace", {{"width", graph.trace.width}, {"height", graph.trace.height}}},
          {"params", params},
          {"outputs", outputs},
          {"culled", remarks(graph.culled)},
          {"bypassed", remarks(graph.bypassed)},
          {"notes", graph.notes},
          {"memory", {{"values_bytes", memory.total}, {"history_rings_bytes", memory.rings}}}};
}

Json sharing_records(const MemorySharing& sharing) {
  Json records = Json::array();
  for (const SharedHeap& heap : sharing.heaps)
    records.push_back(
        {{"bytes", heap.bytes}, {"lower_bound_bytes", heap.lower_bound}, {"unshared_bytes", heap.unshared}});
  return records;
}

Json pass_records(const Plan& plan, const std::vector<std::vector<PassTime>>& frames) {
  Json records = Json::array();
  for (size_t step = 0; step < plan.steps.size(); ++step) {
    std::vector<double> times;
    for (const std::vector<PassTime>& frame : frames) times.push_back(frame.at(step).milliseconds);
    const bool known = std::all_of(times.begin(), times.end(), [](double time) { return time >= 0; });
    Json record = pass_record(plan.graph, plan.graph.passes[plan.steps[step].pass]);
    record["median_ms"] = known ? Json(median(times)) : Json();
    record["frames_ms"] = known ? Json(times) : Json();
    records.push_back(std::move(record));
  }
  return records;
}

Json once_records(const Plan& plan, const std::vector<PassTime>& times) {
  Json records = Json::array();
  for (size_t step = 0; step < plan.once.size(); ++step) {
    const GraphPass& pass = plan.graph.passes[plan.once[step].pass];
    const double time = times.at(step).milliseconds;
    Json record = pass_record(plan.graph, pass);
    record["reason"] = pass.once;
    record["ms"] = time >= 0 ? Json(time) : Json();
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace lightloom::run
