#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/base/json_schema.hpp"
#include "framework/graph/plan_json.hpp"

namespace lightloom {
namespace {

using Json = nlohmann::ordered_json;

Json text() {
  return {{"type", "string"}};
}
Json flag() {
  return {{"type", "boolean"}};
}
Json count() {
  return {{"type", "integer"}, {"minimum", 0}};
}
Json milliseconds() {
  return {{"type", "number"}, {"minimum", 0}};
}
Json one_of(const std::vector<std::string>& texts) {
  return {{"enum", texts}};
}
Json list_of(const Json& items) {
  return {{"type", "array"}, {"items", items}};
}
Json color() {
  return {{"type", "array"}, {"minItems", 4}, {"maxItems", 4}, {"items", {{"type", "number"}}}};
}
Json or_null(const Json& form) {
  return {{"anyOf", Json::array({form, {{"type", "null"}}})}};
}

struct Member {
  const char* key;
  const char* doc;
  Json form;
};

/// An object that has all of these members and no others.
Json record(const std::vector<Member>& members) {
  std::vector<KeyDoc> table;
  SchemaForms forms;
  std::vector<std::string> keys;
  for (const Member& member : members) {
    table.push_back({member.key, member.doc});
    forms.emplace(member.key, member.form);
    keys.emplace_back(member.key);
  }
  return object_schema(table, std::move(forms), keys);
}

Json size() {
  return record({{"width", "[pixels]", count()}, {"height", "[pixels]", count()}});
}

Json value_record() {
  const Json place = record({{"heap", "Index into memory.heaps", count()},
                             {"offset", "Where it begins [bytes]", count()},
                             {"bytes", "What the device says it needs", count()}});
  return record(
      {{"name", "PASS.PORT or PASS.PORT.PART", text()},
       {"pass", "Who writes it, or would if it were on", text()},
       {"port", "Output or scratch port", text()},
       {"part", "Of a bundle; else empty", text()},
       {"format", "Of a texel", text()},
       {"dimension", "2: image, 3: volume", {{"enum", Json::array({2, 3})}}},
       {"width", "[texels]", count()},
       {"height", "[texels]", count()},
       {"depth", "[texels]", count()},
       {"layers", "Frames that are kept, this one included", count()},
       {"bytes", "Of all layers, tightly packed", count()},
       {"scratch", "Only its pass uses it", flag()},
       {"kept",
        "How long its contents matter: in the frame, as history of later frames, as what its pass goes "
        "on from, or for all frames",
        one_of({"frame", "history", "persistent", "once", "constant"})},
       {"constant", "The colour of a constant, which stands for an output of a pass that is off", or_null(color())},
       {"first_step", "First step of a frame that touches it; index into steps", or_null(count())},
       {"last_step", "Last step of a frame that touches it", or_null(count())},
       {"place", "Where it lies if it shares memory; null too where no device was asked", or_null(place)}});
}

Json barrier_record() {
  return record(
      {{"value", "Whose accesses it orders: a value, \"frame inputs\" or \"everything\"", text()},
       {"from", "What it waits for; explained under accesses", text()},
       {"to", "What waits", text()},
       {"hazard", "What would go wrong", one_of({"read after write", "write after read", "write after write"})},
       {"previous_frame", "What it waits for is of an earlier frame", flag()},
       {"takes_over", "The value takes memory over from others", flag()},
       {"reason", "In words", text()}});
}

Json step_record() {
  const Json scalar = {{"type", Json::array({"number", "string", "boolean"})}};
  const Json params = {{"type", "object"}, {"additionalProperties", scalar}};
  const Member port{"port", "Of the pass", text()};
  const Member part{"part", "Of a bundle; else empty", text()};
  const Member access{"access", "Explained under accesses", text()};
  const Json input = record({port,
                             part,
                             {"value", "What it reads", text()},
                             access,
                             {"first_age", "0: this frame's; K: that of K frames ago", count()},
                             {"last_age", "Oldest of a range", count()}});
  const Json written = record({port, part, {"value", "What it writes", text()}, access});
  return record({{"pass", "Name of the node", text()},
                 {"type", "Pass type", text()},
                 {"version", "Of the pass type", count()},
                 {"host", "It computes on the host", flag()},
                 {"once", "Why it runs in the first frame alone; null: it runs in every frame", or_null(text())},
                 {"params", "All of them, resolved", params},
                 {"inputs", "What it reads", list_of(input)},
                 {"unconnected", "Optional inputs without a source", list_of(text())},
                 {"outputs", "What it writes", list_of(written)},
                 {"scratch", "What it uses alone", list_of(written)},
                 {"barriers", "Recorded before it", list_of(schema_reference("barrier"))},
                 {"observations", "After it", list_of(schema_reference("observation"))}});
}

Json observation_record() {
  return record(
      {{"value", "What is looked at", text()},
       {"age", "K: as it was K frames ago", count()},
       {"observer", "Copied to the host, or searched for what no texel should hold", one_of({"read_back", "scan"})},
       {"barriers", "Recorded before it", list_of(schema_reference("barrier"))}});
}

Json memory_record() {
  const Json heap =
      record({{"bytes", "Of the heap", count()},
              {"lower_bound", "Largest sum that is live in one step: no sharing needs less [bytes]", count()},
              {"unshared", "What its values would need apart [bytes]", count()}});
  return record({{"total_bytes", "All values, tightly packed and apart", count()},
                 {"ring_bytes", "The part of it in histories", count()},
                 {"heaps", "Memory that values share; null where no device was asked", or_null(list_of(heap))}});
}

Json times_record() {
  return record({{"run", "Run folder they are from", text()},
                 {"step_ms", "By step of a frame: median over the run's frames", list_of(milliseconds())},
                 {"earliest_ms", "By step: when it could begin", list_of(milliseconds())},
                 {"sum_ms", "One step after another", milliseconds()},
                 {"critical_path_ms", "The longest chain of steps that wait for one another", milliseconds()},
                 {"critical_steps", "That chain; indices into steps", list_of(count())}});
}

}  // namespace

Json plan_schema() {
  const Json barriers = list_of(schema_reference("barrier"));
  const Json steps = list_of(schema_reference("step"));
  const Json remarks = list_of(record({{"pass", "Name of the node", text()}, {"reason", "Why", text()}}));
  const Json access =
      record({{"stages", "Pipeline stages", list_of(text())}, {"access", "Access bits", list_of(text())}});
  const Json clear = record({{"value", "What is cleared", text()}, {"color", "To what", color()}});
  const Json output = record({{"name", "Of the graph", text()},
                              {"value", "What is written", text()},
                              {"age", "K: as it was K frames ago", count()}});
  const Json params = {{"type", "object"},
                       {"additionalProperties", {{"type", Json::array({"number", "string", "boolean"})}}}};
  Json body =
      record({{"lightloom_plan", "Version of the format", {{"const", 1}}},
              {"graph", "Its name", text()},
              {"hash", "Of all that is executed", text()},
              {"general", "Made as if the scene had every feature", flag()},
              {"view", "Size of the picture", size()},
              {"trace", "Size at which is traced", size()},
              {"params", "Of the graph", params},
              {"values", "Images and volumes", list_of(schema_reference("value"))},
              {"clears", "Once, before anything else", list_of(clear)},
              {"prologue_barriers", "After the clears", barriers},
              {"once", "What runs in the first frame alone, in order", steps},
              {"once_barriers", "After it", barriers},
              {"frame_start", "Before the scene's buffers are written for a frame", barriers},
              {"inputs_ready", "After that", barriers},
              {"opening_observations", "Of what no step of a frame makes", list_of(schema_reference("observation"))},
              {"steps", "What every frame runs, in order", steps},
              {"outputs", "Of the graph", list_of(output)},
              {"captures", "Values that are dumped", list_of(text())},
              {"culled", "Passes that nothing needs", remarks},
              {"bypassed", "Passes that are off", remarks},
              {"notes", "What else there is to say", list_of(text())},
              {"accesses",
               "What the names of accesses mean in Vulkan",
               {{"type", "object"}, {"additionalProperties", access}}},
              {"memory", "Of the values", schema_reference("memory")},
              {"times", "Of a run; null where none was named", or_null(schema_reference("times"))}});
  body["$defs"] = {{"value", value_record()}, {"barrier", barrier_record()}, {"observation", observation_record()},
                   {"step", step_record()},   {"memory", memory_record()},   {"times", times_record()}};
  return schema_document("Lightloom plan",
                         "What a frame of a graph executes, in order, and why. Made by `lightloom schema plan`.", body);
}

}  // namespace lightloom
