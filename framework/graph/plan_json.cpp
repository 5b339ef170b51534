#include "framework/graph/plan_json.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "framework/base/hash.hpp"
#include "framework/graph/access_names.hpp"
#include "framework/graph/critical_path.hpp"
#include "framework/graph/lifetime.hpp"

namespace lightloom {
namespace {

using Json = nlohmann::ordered_json;

Json optional_index(const std::optional<uint32_t>& index) {
  return index ? Json(*index) : Json();
}

Json param_json(const ParamValue& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

class PlanWriter {
 public:
  PlanWriter(const Plan& plan, const PlanFacts& facts)
      : plan_(plan), graph_(plan.graph), facts_(facts), lives_(lifetimes(plan)) {}

  Json run() {
    Json json = {{"lightloom_plan", 1},
                 {"graph", graph_.name},
                 {"hash", hex(plan_hash(plan_))},
                 {"general", graph_.general},
                 {"view", {{"width", graph_.view.width}, {"height", graph_.view.height}}},
                 {"trace", {{"width", graph_.trace.width}, {"height", graph_.trace.height}}}};
    json["params"] = Json::object();
    for (const auto& [name, value] : graph_.params) json["params"][name] = param_json(value);
    json["values"] = values();
    execution(json);
    json["outputs"] = outputs();
    json["captures"] = Json::array();
    for (const ValueId value : graph_.captures) json["captures"].push_back(value_name(graph_.values[value]));
    json["culled"] = remarks(graph_.culled);
    json["bypassed"] = remarks(graph_.bypassed);
    json["notes"] = graph_.notes;
    json["accesses"] = accesses();
    json["memory"] = memory();
    json["times"] = times();
    return json;
  }

 private:
  Json values() const {
    Json list = Json::array();
    for (ValueId id = 0; id < graph_.values.size(); ++id) {
      const Value& value = graph_.values[id];
      const Extent3& extent = value.desc.extent;
      list.push_back({{"name", value_name(value)},
                      {"pass", value.pass},
                      {"port", value.port},
                      {"part", value.part},
                      {"format", format_info(value.desc.format).name},
                      {"dimension", value.desc.dimension == Dimension::d3 ? 3 : 2},
                      {"width", extent.width},
                      {"height", extent.height},
                      {"depth", extent.depth},
                      {"layers", ring_layers(value)},
                      {"bytes", byte_size(value)},
                      {"scratch", value.scratch},
                      {"kept", to_string(lives_[id].keeping)},
                      {"constant", value.constant ? Json(*value.constant) : Json()},
                      {"first_step", optional_index(lives_[id].first)},
                      {"last_step", lives_[id].first ? Json(lives_[id].last) : Json()},
                      {"place", place(id)}});
    }
    return list;
  }

  Json place(ValueId id) const {
    if (!facts_.memory || !facts_.memory->sharing.places[id]) return nullptr;
    const SharedPlace& place = *facts_.memory->sharing.places[id];
    return {{"heap", place.heap}, {"offset", place.offset}, {"bytes", facts_.memory->needs[id].size}};
  }

  void execution(Json& json) {
    json["clears"] = Json::array();
    for (const Clear& clear : plan_.prologue)
      json["clears"].push_back({{"value", value_name(graph_.values[clear.value])}, {"color", clear.color}});
    json["prologue_barriers"] = barriers(plan_.prologue_barriers);
    json["once"] = steps(plan_.once);
    json["once_barriers"] = barriers(plan_.once_barriers);
    json["frame_start"] = barriers(plan_.frame_start);
    json["inputs_ready"] = barriers(plan_.inputs_ready);
    json["opening_observations"] = observations(plan_.opening_observations);
    json["steps"] = steps(plan_.steps);
  }

  Json barriers(const std::vector<Barrier>& list) {
    Json result = Json::array();
    for (const Barrier& barrier : list)
      result.push_back({{"value", barrier_subject(graph_, barrier.value)},
                        {"from", access(barrier.from)},
                        {"to", access(barrier.to)},
                        {"hazard", to_string(barrier.hazard)},
                        {"previous_frame", barrier.previous_frame},
                        {"takes_over", barrier.takes_over},
                        {"reason", barrier.reason}});
    return result;
  }

  Json observations(const std::vector<Observation>& list) {
    Json result = Json::array();
    for (const Observation& observation : list)
      result.push_back({{"value", value_name(graph_.values[observation.value])},
                        {"age", observation.age},
                        {"observer", observation.observer == Observer::scan ? "scan" : "read_back"},
                        {"barriers", barriers(observation.barriers)}});
    return result;
  }

  Json steps(const std::vector<PlanStep>& list) {
    Json result = Json::array();
    for (const PlanStep& step : list) {
      const GraphPass& pass = graph_.passes[step.pass];
      Json params = Json::object();
      for (const ParamSet::Entry& entry : pass.params.entries()) params[entry.param->name] = param_json(entry.value);
      result.push_back({{"pass", pass.name},
                        {"type", pass.type->name},
                        {"version", pass.type->version},
                        {"host", static_cast<bool>(pass.type->host)},
                        {"once", pass.once.empty() ? Json() : Json(pass.once)},
                        {"params", params},
                        {"inputs", inputs(pass.inputs)},
                        {"unconnected", pass.unconnected},
                        {"outputs", written(pass.outputs)},
                        {"scratch", written(pass.scratch)},
                        {"barriers", barriers(step.barriers)},
                        {"observations", observations(step.observations)}});
    }
    return result;
  }

  Json inputs(const std::vector<Use>& uses) {
    Json result = Json::array();
    for (const Use& use : uses)
      result.push_back({{"port", use.port},
                        {"part", use.part},
                        {"value", value_name(graph_.values[use.value])},
                        {"access", access(use.access)},
                        {"first_age", use.first_age},
                        {"last_age", use.last_age}});
    return result;
  }

  Json written(const std::vector<Use>& uses) {
    Json result = Json::array();
    for (const Use& use : uses)
      result.push_back({{"port", use.port},
                        {"part", use.part},
                        {"value", value_name(graph_.values[use.value])},
                        {"access", access(use.access)}});
    return result;
  }

  Json outputs() const {
    Json result = Json::array();
    for (const GraphOutput& output : graph_.outputs)
      result.push_back(
          {{"name", output.name}, {"value", value_name(graph_.values[output.value])}, {"age", output.age}});
    return result;
  }

  static Json remarks(const std::vector<PassRemark>& list) {
    Json result = Json::array();
    for (const PassRemark& remark : list) result.push_back({{"pass", remark.pass}, {"reason", remark.reason}});
    return result;
  }

  /// Its name, which is explained once, under "accesses".
  std::string access(Access access) {
    used_.insert(access);
    return std::string(access_info(access).name);
  }

  Json accesses() const {
    Json result = Json::object();
    for (const Access access : used_) {
      const AccessInfo& info = access_info(access);
      result[std::string(info.name)] = {{"stages", stage_names(info.stages)}, {"access", access_names(info.access)}};
    }
    return result;
  }

  Json memory() const {
    const MemoryUse use = memory_use(graph_);
    Json heaps;
    if (facts_.memory) {
      heaps = Json::array();
      for (const SharedHeap& heap : facts_.memory->sharing.heaps)
        heaps.push_back({{"bytes", heap.bytes}, {"lower_bound", heap.lower_bound}, {"unshared", heap.unshared}});
    }
    return {{"total_bytes", use.total}, {"ring_bytes", use.rings}, {"heaps", heaps}};
  }

  Json times() const {
    if (!facts_.times) return nullptr;
    const CriticalPath path = critical_path(plan_, facts_.times->step_ms);
    return {{"run", facts_.times->run}, {"step_ms", facts_.times->step_ms},   {"earliest_ms", path.earliest_ms},
            {"sum_ms", path.sum_ms},    {"critical_path_ms", path.length_ms}, {"critical_steps", path.steps}};
  }

  const Plan& plan_;
  const Graph& graph_;
  const PlanFacts& facts_;
  std::vector<Lifetime> lives_;
  std::set<Access> used_;
};

}  // namespace

Json plan_json(const Plan& plan, const PlanFacts& facts) {
  return PlanWriter(plan, facts).run();
}

}  // namespace lightloom
