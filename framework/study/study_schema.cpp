#include "framework/study/study_schema.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/json_schema.hpp"
#include "framework/graph/format.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/study/study_keys.hpp"
#include "framework/study/study_spec.hpp"

namespace lightloom::study {
namespace {

using Json = nlohmann::ordered_json;

static_assert(kMaximumImageSize == 16384, "the pattern of sizes says so");
constexpr const char* kSizePattern =
    "^0*([1-9][0-9]{0,3}|1[0-5][0-9]{3}|16[0-2][0-9]{2}|163[0-7][0-9]|1638[0-4])"
    "x0*([1-9][0-9]{0,3}|1[0-5][0-9]{3}|16[0-2][0-9]{2}|163[0-7][0-9]|1638[0-4])$";
constexpr int64_t kLargestSeed = 0xffffffff;

Json text_schema() {
  return {{"type", "string"}};
}
Json flag_schema() {
  return {{"type", "boolean"}};
}
Json either(const Json& one, const Json& other) {
  return {{"anyOf", Json::array({one, other})}};
}
Json with_default(Json form, const Json& fallback) {
  form["default"] = fallback;
  return form;
}
Json list_of(const Json& items) {
  return {{"type", "array"}, {"items", items}};
}
/// One or more, all different.
Json set_of(const Json& items) {
  return {{"type", "array"}, {"minItems", 1}, {"uniqueItems", true}, {"items", items}};
}

SchemaForms change_forms() {
  return {{"variants", schema_reference("names")},  {"set", schema_reference("set")},
          {"disable", schema_reference("names")},   {"swap", schema_reference("swap")},
          {"formats", schema_reference("formats")}, {"size", schema_reference("size")},
          {"trace_size", schema_reference("size")}, {"general", flag_schema()}};
}

SchemaForms operator+(SchemaForms one, const SchemaForms& other) {
  one.insert(other.begin(), other.end());
  return one;
}

Json scenes_schema() {
  const Json choice =
      object_schema(kSceneChoiceKeys, {{"scene", text_schema()}, {"cameras", schema_reference("names")}}, {"scene"});
  return {{"type", "array"}, {"minItems", 1}, {"items", either(text_schema(), choice)}};
}

Json frames_schema(const StudySpec& defaults) {
  const Json number = integer_schema(0, kMostFrames);
  const Json rate = {{"type", "number"}, {"minimum", 1e-6}, {"maximum", 1e6}};
  return either(schema_reference("frame_count"),
                object_schema(kFramesKeys, {{"count", with_default(schema_reference("frame_count"), defaults.frames)},
                                            {"warm_up", with_default(number, defaults.warm_up)},
                                            {"first", with_default(number, defaults.first_frame)},
                                            {"judged", with_default(schema_reference("frame_count"), defaults.judged)},
                                            {"per_second", with_default(rate, defaults.frames_per_second)}}));
}

Json seeds_schema() {
  Json list = set_of(schema_reference("seed"));
  list["maxItems"] = kMostSeeds;
  return either(integer_schema(1, kMostSeeds), list);
}

Json variants_schema() {
  const Json name = {{"type", "string"}, {"minLength", 1}};
  return list_of(either(text_schema(), object_schema(joined({kNameKeys, kChangeKeys}),
                                                     change_forms() + SchemaForms{{"name", name}}, {"name"})));
}

Json sweep_schema() {
  const Json named = schema_reference("named_changes");
  const Json sizes = either(set_of(schema_reference("size")), named);
  return {{"type", "object"},
          {"properties", {{"size", sizes}, {"trace_size", sizes}, {"general", either(set_of(flag_schema()), named)}}},
          {"additionalProperties", either(set_of(schema_reference("scalar")), named)}};
}

Json reference_schema() {
  const SchemaForms common = {{"frames", schema_reference("frame_count")},
                              {"seed", schema_reference("seed")},
                              {"average", with_default(flag_schema(), false)},
                              {"match", schema_reference("names")}};
  const Json image = object_schema(kReferenceImageKeys, {{"image", text_schema()}}, {"image"});
  const Json setting = object_schema(joined({kReferenceSettingKeys, kReferenceKeys}),
                                     common + SchemaForms{{"setting", schema_reference("changes")}}, {"setting"});
  const Json graph = object_schema(joined({kReferenceGraphKeys, kChangeKeys, kReferenceKeys}),
                                   common + change_forms() + SchemaForms{{"graph", text_schema()}}, {"graph"});
  return {{"oneOf", Json::array({image, setting, graph})}};
}

Json definitions() {
  const Json scalars = {{"type", "object"}, {"additionalProperties", schema_reference("scalar")}};
  const Json types = {{"type", "object"}, {"additionalProperties", text_schema()}};
  const Json named = {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", schema_reference("changes")}};
  return {{"names", list_of(text_schema())},
          {"scalar", {{"type", Json::array({"string", "number", "boolean"})}}},
          {"size", string_schema(kSizePattern)},
          {"frame_count", integer_schema(1, kMostFrames)},
          {"seed", integer_schema(0, kLargestSeed)},
          {"set", scalars},
          {"swap", types},
          {"formats", {{"type", "object"}, {"additionalProperties", {{"enum", format_names()}}}}},
          {"changes", object_schema(kChangeKeys, change_forms())},
          {"named_changes", named}};
}

}  // namespace

Json study_schema() {
  const StudySpec defaults;
  Json body = object_schema(kStudyKeys,
                            {{"$schema", text_schema()},
                             {"lightloom_study", {{"const", kStudyFormatVersion}}},
                             {"name", text_schema()},
                             {"description", text_schema()},
                             {"graph", text_schema()},
                             {"scenes", scenes_schema()},
                             {"size", schema_reference("size")},
                             {"trace_size", schema_reference("size")},
                             {"changes", schema_reference("changes")},
                             {"frames", frames_schema(defaults)},
                             {"seeds", seeds_schema()},
                             {"variants", variants_schema()},
                             {"ablate", schema_reference("names")},
                             {"factorial", with_default(flag_schema(), false)},
                             {"sweep", sweep_schema()},
                             {"mode", {{"enum", Json::array({"crossed", "one_at_a_time"})}, {"default", "crossed"}}},
                             {"reference", reference_schema()},
                             {"metrics", set_of({{"enum", metric_names()}})},
                             {"output", with_default(text_schema(), defaults.output)},
                             {"jobs", with_default(integer_schema(1, kMostJobs), defaults.jobs)}},
                            {"lightloom_study", "graph", "scenes"});
  body["dependentRequired"] = {{"factorial", Json::array({"ablate"})}};
  body["$defs"] = definitions();
  return schema_document("Lightloom study",
                         "What `lightloom study` runs; docs/studies.md explains it. Paths are relative to the study "
                         "file. Made by `lightloom schema study`.",
                         body);
}

}  // namespace lightloom::study
