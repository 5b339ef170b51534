#include "framework/graph/graph_schema.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "framework/graph/graph_spec.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/schema_check.hpp"
#include "tests/support/toy_graphs.hpp"

// The published schema of graph files against the reader, which decides by code of its own. The validator is Python's.
namespace lightloom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Every feature that a graph that ships asks for.
LinkEnvironment environment() {
  LinkEnvironment all = toy::environment();
  all.scene_features.emplace_back("emissive", true);
  all.scene_features.emplace_back("specular", true);
  return all;
}

std::vector<std::string> features() {
  std::vector<std::string> names;
  for (const auto& [name, present] : environment().scene_features) names.push_back(name);
  return names;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json" && entry.path().filename() != "expected.json")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class GraphSchema : public ::testing::Test {
 protected:
  std::vector<std::string> check(const std::vector<fs::path>& files, const PassRegistry& types = real_passes()) {
    return folder.check(folder.write("schema", graph_schema(types, features()).dump()), files);
  }
  std::vector<std::string> check(const std::vector<std::string>& texts, const PassRegistry& types = real_passes()) {
    std::vector<fs::path> files;
    for (const std::string& text : texts) files.push_back(folder.write(std::to_string(files.size()), text));
    return check(files, types);
  }

  test::SchemaFolder folder;
};

TEST_F(GraphSchema, AcceptsTheGraphsThatShip) {
  std::vector<fs::path> files = files_in(source_dir() / "graphs");
  for (const fs::path& file : files_in(source_dir() / "samples/graphs")) files.push_back(file);
  for (const fs::path& file : files_in(source_dir() / "samples/compute_pass")) files.push_back(file);
  ASSERT_GE(files.size(), 6U);
  const std::vector<std::string> answers = check(files);
  for (size_t i = 0; i < files.size(); ++i) EXPECT_EQ(answers[i], "yes") << files[i];
}

/// What is wrong in these takes more to see than one place of a file, which is all that a schema has.
const std::map<std::string, std::string> kBeyondSchema = {
    {"cycle.json", "edges that lead round in a circle"},
    {"cycle_of_one.json", "an edge of a pass to itself"},
    {"dimensions.json", "a volume where an image is needed: the other end of the edge says so"},
    {"duplicate_key.json", "a key that stands twice: JSON readers see the last alone"},
    {"missing_graph_param.json", "a \"$name\" that the graph does not declare"},
    {"no_bypass.json", "an output of a disabled pass that somebody needs"},
    {"numeric.json", "integers where floats are needed: the other end of the edge says so"},
    {"shapes.json", "inputs that must be of one size"},
    {"size_from_itself.json", "a size that follows from itself"},
    {"typo_edge.json", "passes, ports and parts that are not there"},
    {"unused_param.json", "a param that no pass takes"},
};

TEST_F(GraphSchema, RefusesBrokenGraphsByEveryRuleThatASchemaCanSay) {
  const std::vector<fs::path> files = files_in(source_dir() / "tests/graphs_bad");
  const std::vector<std::string> answers = check(files);
  size_t beyond = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    const auto reason = kBeyondSchema.find(files[i].filename().string());
    if (reason == kBeyondSchema.end()) {
      EXPECT_NE(answers[i], "yes") << files[i];
    } else {
      EXPECT_EQ(answers[i], "yes") << files[i] << ": " << reason->second;
      ++beyond;
    }
  }
  EXPECT_EQ(beyond, kBeyondSchema.size()) << "a file of the list is gone";
}

TEST_F(GraphSchema, RefusesBrokenPassesOfTypeCompute) {
  const fs::path folder_of_bad = source_dir() / "tests/graphs_bad/compute";
  const std::vector<std::string> answers = check(
      std::vector<fs::path>{folder_of_bad / "keys.json", folder_of_bad / "sizes.json", folder_of_bad / "no_shader.json",
                            folder_of_bad / "other_type.json", folder_of_bad / "missing_param.json"});
  for (size_t i = 0; i < 4; ++i) EXPECT_NE(answers[i], "yes") << i;
  EXPECT_EQ(answers[4], "yes") << "what params there are, only the shader knows";
}

/// A graph with one pass, which may be off, so that it needs no inputs.
std::string with_param(const std::string& type, const std::string& param, const Json& value) {
  const Json pass = {{"type", type}, {"enabled", false}, {"params", {{param, value}}}};
  return Json{{"lightloom", 1}, {"passes", {{"a", pass}}}, {"outputs", {{"o", "a.b"}}}}.dump();
}

struct Trial {
  std::string text;
  bool accepted = false;
};

/// Values of a param at its ends, beyond them, and of other types.
std::vector<Trial> trials_of(const std::string& type, const Param& param) {
  std::vector<Trial> trials;
  const auto add = [&](const Json& value, bool accepted) {
    trials.push_back({with_param(type, param.name, value), accepted});
  };
  add(std::visit([](const auto& value) { return Json(value); }, param.default_value), true);
  add("$name", true);
  add("$Name", false);
  add(nullptr, false);
  add(Json::array({1}), false);
  add(true, param.type == ParamType::boolean);
  add("no such choice", false);
  for (const std::string& choice : param.choices) add(choice, true);
  const auto number = [&](double value) {
    return param.type == ParamType::integer ? Json(static_cast<int64_t>(value)) : Json(value);
  };
  if (param.type == ParamType::integer) add(0.5, false);
  if (param.minimum) add(number(*param.minimum), true);
  if (param.minimum) add(number(*param.minimum - 1), false);
  if (param.maximum) add(number(*param.maximum), true);
  if (param.maximum) add(number(*param.maximum + 1), false);
  return trials;
}

TEST_F(GraphSchema, KnowsTypeRangeAndChoicesOfEveryParam) {
  std::vector<Trial> trials;
  for (const std::string& type : real_passes().names()) {
    for (const Param& param : real_passes().find(type)->params)
      for (Trial& trial : trials_of(type, param)) trials.push_back(std::move(trial));
    trials.push_back({with_param(type, "no_such_param", 1), false});
  }
  std::vector<std::string> texts;
  for (const Trial& trial : trials) texts.push_back(trial.text);
  const std::vector<std::string> answers = check(texts);
  for (size_t i = 0; i < trials.size(); ++i) EXPECT_EQ(answers[i], trials[i].accepted ? "yes" : "no") << texts[i];
  EXPECT_GT(trials.size(), 300U);
}

TEST_F(GraphSchema, KnowsTheFormsOfEdges) {
  const std::vector<std::pair<std::string, std::string>> trials = {
      {"trail:past", "a.b"},       {"trail:past", "a.b.c"},      {"trail:past", "a.b@1"},
      {"trail:past", "a.b@1..15"}, {"trail:past", "a.b.c@2..3"}, {"trail:past", "a.b@01..002"},
      {"trail:past", "a.b@0"},     {"trail:past", "a.b@16"},     {"trail:past", "a.b@1..16"},
      {"trail:past", "a"},         {"trail:past", "a.b.c.d"},    {"trail:past", "A.b"},
      {"trail:past", "a.b@"},      {"trail:past", "a.b@1.."},    {"trail:past", "a.b@-1"},
      {"trail:past", " a.b"},      {"filter:x", "a.b@4"},        {"filter:x", "a.b@4..4"},
      {"filter:x", "a.b@4..5"},    {"filter:x", "a.b@1..11"},    {"pick:p", "a.b"},
      {"pick:p", "a.b@3..3"},      {"pick:p", "a.b@3..4"},       {"pick:p", "a.b.c"},
  };
  std::vector<std::string> texts;
  std::vector<bool> accepted;
  for (const auto& [port, edge] : trials) {
    const std::string type = port.substr(0, port.find(':'));
    const std::string name = port.substr(port.find(':') + 1);
    const Json pass = {{"type", type}, {"enabled", false}, {"in", {{name, edge}}}};
    texts.push_back(Json{{"lightloom", 1}, {"passes", {{"n", pass}}}, {"outputs", {{"o", "n.a"}}}}.dump());
    const EdgeParse parsed = parse_edge(edge);
    const bool range = parsed.edge && parsed.edge->first_age != parsed.edge->last_age;
    accepted.push_back(parsed.edge && !(range && type != "trail") && !(!parsed.edge->part.empty() && type == "pick"));
  }
  const std::vector<std::string> answers = check(texts, toy::registry());
  for (size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(answers[i], accepted[i] ? "yes" : "no") << texts[i];
}

/// One change anywhere in a graph: another value, a member gone, a member more.
std::string mutated(const Json& graph, std::mt19937& random) {
  const auto draw = [&](size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random); };
  const Json flat = graph.flatten();
  auto at = flat.begin();
  std::advance(at, draw(flat.size()));
  Json changed = graph;
  Json::json_pointer place(at.key());
  const std::vector<Json> values = {0,
                                    1,
                                    -1,
                                    2.5,
                                    1e9,
                                    true,
                                    "$radius",
                                    "$none",
                                    "box",
                                    "off",
                                    "trace.radiance",
                                    "trace.radiance@2",
                                    "gather.surface",
                                    nullptr,
                                    "x y",
                                    "gather",
                                    "temporal_accumulate"};
  switch (draw(5)) {
    case 0: {
      const std::string key = place.back();
      place.pop_back();
      if (changed[place].is_object()) changed[place].erase(key);
      break;
    }
    case 1:
      place.pop_back();
      if (changed[place].is_object())
        changed[place][std::vector<std::string>{"doc", "enabled", "wehn", "radiance", "bounces"}[draw(5)]] =
            values[draw(values.size())];
      break;
    default:
      changed[place] = values[draw(values.size())];
  }
  return changed.dump();
}

TEST_F(GraphSchema, AcceptsWhateverTheReaderAccepts) {
  std::mt19937 random(11);
  std::vector<std::string> texts;
  for (const char* name : {"graphs/paper.json", "graphs/lightloom.json", "graphs/stages.json"}) {
    const Json graph = Json::parse(read_text_file(source_dir() / name));
    for (int i = 0; i < 100; ++i) texts.push_back(mutated(graph, random));
  }
  const std::vector<std::string> answers = check(texts);
  size_t accepted = 0;
  size_t refused = 0;
  for (size_t i = 0; i < texts.size(); ++i) {
    const toy::Result read = toy::link_text(texts[i], {}, real_passes(), environment());
    accepted += read.graph ? 1 : 0;
    refused += answers[i] == "no" ? 1 : 0;
    EXPECT_FALSE(read.graph && answers[i] != "yes") << texts[i];
  }
  RecordProperty("accepted", static_cast<int>(accepted));
  RecordProperty("refused", static_cast<int>(refused));
  EXPECT_GT(accepted, 30U);
  EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace lightloom
