#include "framework/graph/graph_schema.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/base/json_schema.hpp"
#include "framework/base/text.hpp"
#include "framework/graph/graph_keys.hpp"
#include "framework/graph/graph_spec.hpp"

namespace lightloom {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kName = "[a-z][a-z0-9_]*";
/// Of a pass output: "pass.port", and where one image is meant "pass.port.part" as well.
constexpr const char* kPort = "^[a-z][a-z0-9_]*\\.[a-z][a-z0-9_]*";
constexpr const char* kPart = "(\\.[a-z][a-z0-9_]*)?";

std::string whole(const std::string& pattern) {
  return "^" + pattern + "$";
}

/// Ages 1 to kMaximumAge, with zeros before them if one likes.
std::string age_pattern() {
  std::vector<std::string> ages;
  for (uint32_t age = 1; age <= kMaximumAge; ++age) ages.push_back(std::to_string(age));
  return "0*(" + join(ages, "|") + ")";
}

Json described(const std::string& description, const Json& form) {
  Json json = {{"description", description}};
  json.update(form);
  return json;
}

Json edge_definitions() {
  const std::string age = age_pattern();
  // A range of one frame is no more than that frame: the group numbers are those of the ages.
  const std::string of_one = "(@" + age + "(\\.\\.0*\\";
  const std::string any_age = "(@" + age + "(\\.\\." + age + ")?)?$";
  return {
      {"edge", described("One image: \"pass.port\" or \"pass.port.part\"; @K is that of K frames ago",
                         string_schema(kPort + std::string(kPart) + of_one + "3)?)?$"))},
      {"bundle_edge",
       described("A bundle: \"pass.port\"; @K is that of K frames ago", string_schema(kPort + of_one + "2)?)?$"))},
      {"range_edge", described("One image over time: \"pass.port@A..B\" or \"pass.port.part@A..B\", A to B frames ago",
                               string_schema(kPort + std::string(kPart) + any_age))}};
}

Json scalar_schema() {
  return {{"type", Json::array({"number", "string", "boolean"})}};
}

Json value_schema(const Param& param) {
  Json schema;
  switch (param.type) {
    case ParamType::boolean:
      return {{"type", "boolean"}};
    case ParamType::choice:
      return {{"enum", param.choices}};
    case ParamType::integer:
      schema["type"] = "integer";
      break;
    case ParamType::real:
      schema["type"] = "number";
      break;
  }
  const auto limit = [&](const char* key, const std::optional<double>& bound) {
    if (!bound) return;
    if (param.type == ParamType::integer)
      schema[key] = static_cast<int64_t>(*bound);
    else
      schema[key] = *bound;
  };
  limit("minimum", param.minimum);
  limit("maximum", param.maximum);
  return schema;
}

Json param_schema(const Param& param) {
  const std::string unit = param.unit.empty() ? "" : " [" + param.unit + "]";
  Json schema = {{"description", param.doc + unit}};
  schema["default"] = std::visit([](const auto& value) { return Json(value); }, param.default_value);
  schema["anyOf"] = Json::array({value_schema(param), schema_reference("graph_param")});
  return schema;
}

std::string port_doc(const Port& port) {
  std::string doc = port.doc;
  const std::string kind = !port.bundle.empty()              ? "bundle '" + port.bundle + "'"
                           : port.dimension == Dimension::d3 ? "volume"
                           : port.array                      ? "images of several frames"
                                                             : "image";
  return doc + (doc.empty() ? "" : " ") + "(" + kind + (port.optional ? ", optional)" : ")");
}

Json inputs_schema(const PassType& type) {
  Json properties = Json::object();
  for (const Port& port : type.ports) {
    if (port.direction != Direction::in) continue;
    const char* form = port.array ? "range_edge" : port.bundle.empty() ? "edge" : "bundle_edge";
    properties[port.name] = described(port_doc(port), schema_reference(form));
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

/// Inputs that a pass needs when it runs: not where it is off, or may be for want of a scene feature.
Json required_inputs(const PassType& type) {
  std::vector<std::string> names;
  for (const Port& port : type.ports)
    if (port.direction == Direction::in && !port.optional) names.push_back(port.name);
  if (names.empty()) return nullptr;
  const Json off = {
      {"anyOf", Json::array({{{"required", {"when"}}},
                             {{"required", {"enabled"}}, {"properties", {{"enabled", {{"const", false}}}}}}})}};
  return {{"if", off}, {"else", {{"required", {"in"}}, {"properties", {{"in", {{"required", names}}}}}}}};
}

/// By name, those that a graph may store in another format.
Json formats_schema(const PassType& type) {
  Json properties = Json::object();
  for (const Port& port : type.ports) {
    if (port.direction == Direction::in || !port.exact_format.empty()) continue;
    std::vector<std::string> of_bundle;
    for (const PortPart& part : port.parts) {
      std::vector<std::string> names;
      for (const Format format : storage_choices(part.format)) names.emplace_back(format_info(format).name);
      if (names.size() < 2) continue;
      for (const std::string& name : names)
        if (std::find(of_bundle.begin(), of_bundle.end(), name) == of_bundle.end()) of_bundle.push_back(name);
      if (!part.name.empty())
        properties[port.name + "." + part.name] = {{"default", format_info(part.format).name}, {"enum", names}};
    }
    if (!of_bundle.empty()) properties[port.name] = {{"enum", of_bundle}};
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

Json pass_type_schema(const PassType& type) {
  Json params = Json::object();
  for (const Param& param : type.params) params[param.name] = param_schema(param);
  Json schema = {{"description", type.doc},
                 {"properties",
                  {{"in", inputs_schema(type)},
                   {"params", {{"type", "object"}, {"additionalProperties", false}, {"properties", params}}},
                   {"formats", formats_schema(type)}}}};
  if (const Json required = required_inputs(type); !required.is_null()) schema.update(required);
  return schema;
}

Json when_schema(const std::vector<std::string>& scene_features) {
  Json when = Json::array({kSizesDiffer, "!" + std::string(kSizesDiffer)});
  for (const std::string& feature : scene_features) {
    when.push_back("scene." + feature);
    when.push_back("!scene." + feature);
  }
  return {{"enum", when}};
}

Json compute_output_schema() {
  const Json number = {{"type", "number"}};
  const Json color = {{"type", "array"}, {"items", number}, {"minItems", 1}, {"maxItems", 4}};
  return object_schema(
      kComputeOutputKeys,
      {{"format", {{"enum", format_names()}}},
       {"size", string_schema("^(view|trace|grid|like [A-Za-z_][A-Za-z0-9_]*|[0-9]+x[0-9]+(x[0-9]+)?)$")},
       {"bypass", {{"anyOf", Json::array({{{"type", "string"}}, number, color})}}}});
}

/// What names there are, only the shader knows.
Json compute_pass_schema(const std::vector<std::string>& scene_features) {
  const Json edges = {{"anyOf", Json::array({schema_reference("edge"), schema_reference("range_edge")})}};
  const auto values = [](const Json& form) { return Json{{"type", "object"}, {"additionalProperties", form}}; };
  return object_schema(kComputeKeys,
                       {{"type", {{"const", kComputeType}}},
                        {"shader", {{"type", "string"}}},
                        {"in", values(edges)},
                        {"out", values(schema_reference("compute_output"))},
                        {"threads", {{"type", "string"}}},
                        {"params", values(scalar_schema())},
                        {"enabled", {{"type", "boolean"}, {"default", true}}},
                        {"when", when_schema(scene_features)},
                        {"doc", {{"type", "string"}}}},
                       {"type", "shader"});
}

Json pass_schema(const PassRegistry& registry, const std::vector<std::string>& scene_features) {
  const Json object = {{"type", "object"}};
  Json schema = object_schema(kPassKeys,
                              {{"type", schema_reference("pass_type")},
                               {"in", object},
                               {"params", object},
                               {"formats", object},
                               {"enabled", {{"type", "boolean"}, {"default", true}}},
                               {"when", when_schema(scene_features)},
                               {"doc", {{"type", "string"}}}},
                              {"type"});
  // One branch a type, chosen by its name, so that a mistake is reported as what it is.
  Json branches = Json::array();
  for (const std::string& name : registry.names())
    branches.push_back({{"if", {{"required", {"type"}}, {"properties", {{"type", {{"const", name}}}}}}},
                        {"then", schema_reference("type_" + name)}});
  schema["allOf"] = branches;
  return schema;
}

Json type_names(const PassRegistry& registry) {
  Json names = Json::array();
  Json docs = Json::array();
  for (const std::string& name : registry.names()) {
    names.push_back(name);
    docs.push_back(registry.find(name)->doc);
  }
  return {{"enum", names}, {"enumDescriptions", docs}};
}

Json size_schema() {
  const Json length = integer_schema(1, kMaximumImageSize);
  return object_schema(kSizeKeys, {{"width", length}, {"height", length}}, {"width", "height"});
}

Json variant_schema() {
  const Json texts = {{"type", "array"}, {"items", {{"type", "string"}}}};
  return object_schema(kVariantKeys,
                       {{"doc", {{"type", "string"}}},
                        {"disable", texts},
                        {"set", {{"type", "object"}, {"additionalProperties", scalar_schema()}}},
                        {"swap", {{"type", "object"}, {"additionalProperties", schema_reference("pass_type")}}},
                        {"formats", {{"type", "object"}, {"additionalProperties", {{"enum", format_names()}}}}}});
}

/// An object whose keys are names.
Json named(const Json& form, bool required) {
  Json schema = {{"type", "object"}, {"propertyNames", {{"pattern", whole(kName)}}}, {"additionalProperties", form}};
  if (required) schema["minProperties"] = 1;
  return schema;
}

}  // namespace

Json graph_schema(const PassRegistry& registry, const std::vector<std::string>& scene_features) {
  const Json text = {{"type", "string"}};
  Json body = object_schema(kGraphKeys,
                            {{"$schema", text},
                             {"lightloom", {{"const", kGraphFormatVersion}}},
                             {"name", text},
                             {"doc", text},
                             {"view", schema_reference("size")},
                             {"trace", schema_reference("size")},
                             {"params", named(scalar_schema(), false)},
                             {"passes", named(schema_reference("pass"), true)},
                             {"outputs", named(schema_reference("edge"), true)},
                             {"variants", named(schema_reference("variant"), false)}},
                            {"lightloom", "passes", "outputs"});
  Json definitions = edge_definitions();
  definitions["graph_param"] =
      described("A param of the graph: \"$NAME\"", string_schema(std::string("^\\$") + kName + "$"));
  definitions["size"] = size_schema();
  definitions["variant"] = variant_schema();
  definitions["pass_type"] = type_names(registry);
  definitions["compute_output"] = compute_output_schema();
  definitions["compute_pass"] = compute_pass_schema(scene_features);
  definitions["typed_pass"] = pass_schema(registry, scene_features);
  definitions["pass"] = {{"if", {{"required", {"type"}}, {"properties", {{"type", {{"const", kComputeType}}}}}}},
                         {"then", schema_reference("compute_pass")},
                         {"else", schema_reference("typed_pass")}};
  for (const std::string& name : registry.names()) definitions["type_" + name] = pass_type_schema(*registry.find(name));
  body["$defs"] = definitions;
  return schema_document("Lightloom graph",
                         "A render graph: passes and the edges between them. Made by `lightloom schema graph`.", body);
}

}  // namespace lightloom
