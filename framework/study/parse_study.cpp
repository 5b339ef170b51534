#include <algorithm>
#include <set>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/study/spec_reader.hpp"
#include "framework/study/study_keys.hpp"

namespace lightloom::study {
namespace {

class StudyReader : SpecReader {
 public:
  StudyReader(const std::filesystem::path& file, Diagnostics& diagnostics) : SpecReader(diagnostics) {
    spec_.file = file;
    spec_.name = file.stem().string();
  }

  std::optional<StudySpec> read(const JsonNode& root) {
    if (!expect(root, JsonKind::object, "a study") || !check_version(root)) return std::nullopt;
    check_keys(root, kStudyKeys, "a study");
    std::string schema;
    read_text(root, "$schema", schema);
    read_text(root, "name", spec_.name);
    read_text(root, "description", spec_.description);
    read_text(root, "output", spec_.output);
    read_flag(root, "factorial", spec_.factorial);
    read_count(root, "jobs", 1, kMostJobs, spec_.jobs);
    read_what(root);
    read_frames(root);
    read_seeds(root);
    read_settings(root);
    if (const JsonNode* node = root.find("reference")) read_reference(*node);
    read_metrics(root);
    return std::move(spec_);
  }

 private:
  bool check_version(const JsonNode& root) {
    const JsonNode* version = root.find("lightloom_study");
    if (version == nullptr) {
      error("missing-key", root.where, "this is no study: the key 'lightloom_study' is missing",
            "begin the file with \"lightloom_study\": 1");
      return false;
    }
    if (version->kind == JsonKind::integer && version->integer == kStudyFormatVersion) return true;
    error("unknown-version", version->where, "'lightloom_study' must be 1, the version of the file format");
    return false;
  }

  /// Paths of the file are relative to its folder.
  std::filesystem::path path(const std::string& text) const {
    return (spec_.file.parent_path() / text).lexically_normal();
  }

  void read_what(const JsonNode& root) {
    std::string graph;
    read_text(root, "graph", graph);
    if (root.find("graph") == nullptr)
      error("missing-key", root.where, "a study needs a 'graph'", "the path of a graph file, relative to the study");
    spec_.graph = path(graph);
    const JsonNode* scenes = root.find("scenes");
    if (scenes == nullptr) {
      error("missing-key", root.where, "a study needs 'scenes'", "a list of scene files, relative to the study");
    } else if (expect(*scenes, JsonKind::array, "'scenes'")) {
      if (scenes->elements.empty()) error("out-of-range", scenes->where, "'scenes' needs at least one entry");
      for (const JsonNode& scene : scenes->elements) read_scene(scene);
    }
    if (const JsonNode* node = root.find("changes")) spec_.changes = changes(*node, "'changes'");
    read_size(root, "size", spec_.changes.size);
    read_size(root, "trace_size", spec_.changes.trace_size);
  }

  void read_scene(const JsonNode& node) {
    if (node.kind == JsonKind::string) {
      spec_.scenes.push_back({path(node.string), {}});
      return;
    }
    if (node.kind != JsonKind::object)
      return error("wrong-type", node.where, "a scene must be a path, or an object with 'scene' and 'cameras'");
    check_keys(node, kSceneChoiceKeys, "a scene");
    SceneChoice scene;
    std::string file;
    read_text(node, "scene", file);
    if (node.find("scene") == nullptr) error("missing-key", node.where, "a scene needs the key 'scene', its file");
    scene.file = path(file);
    if (const JsonNode* cameras = node.find("cameras")) scene.cameras = texts(*cameras, "'cameras'");
    spec_.scenes.push_back(std::move(scene));
  }

  void read_frames(const JsonNode& root) {
    const JsonNode* node = root.find("frames");
    if (node == nullptr) return;
    if (node->kind == JsonKind::integer) {
      spec_.frames = count(*node, "'frames'", 1, kMostFrames).value_or(spec_.frames);
      spec_.warm_up = std::min(spec_.warm_up, spec_.frames - 1);
      return;
    }
    if (!expect(*node, JsonKind::object, "'frames'")) return;
    check_keys(*node, kFramesKeys, "'frames'");
    read_count(*node, "count", 1, kMostFrames, spec_.frames);
    read_count(*node, "warm_up", 0, kMostFrames, spec_.warm_up);
    read_count(*node, "first", 0, kMostFrames, spec_.first_frame);
    read_count(*node, "judged", 1, kMostFrames, spec_.judged);
    read_real(*node, "per_second", 1e-6, 1e6, spec_.frames_per_second);
    if (node->find("warm_up") == nullptr) spec_.warm_up = std::min(spec_.warm_up, spec_.frames - 1);
    if (spec_.warm_up >= spec_.frames)
      error("out-of-range", node->where,
            "'warm_up' must be less than 'count', " + std::to_string(spec_.frames) + ", so that a frame is timed");
    if (spec_.judged > spec_.frames)
      error("out-of-range", node->where,
            "'judged' cannot be more than 'count', " + std::to_string(spec_.frames) + " frames");
  }

  void read_seeds(const JsonNode& root) {
    const JsonNode* node = root.find("seeds");
    if (node == nullptr) return;
    spec_.seeds.clear();
    if (node->kind == JsonKind::integer) {
      const uint32_t number = count(*node, "'seeds'", 1, kMostSeeds).value_or(1);
      for (uint32_t seed = 0; seed < number; ++seed) spec_.seeds.push_back(seed);
      return;
    }
    if (node->kind != JsonKind::array)
      return error("wrong-type", node->where, "'seeds' must be a number of seeds, or a list of them");
    if (node->elements.empty() || node->elements.size() > kMostSeeds)
      error("out-of-range", node->where, "'seeds' must have 1 to " + std::to_string(kMostSeeds) + " entries");
    for (const JsonNode& element : node->elements) {
      const auto seed = count(element, "a seed", 0, 0xffffffffU);
      if (!seed) continue;
      if (std::find(spec_.seeds.begin(), spec_.seeds.end(), *seed) != spec_.seeds.end())
        error("duplicate", element.where, "seed " + std::to_string(*seed) + " is listed twice");
      spec_.seeds.push_back(*seed);
    }
  }

  void read_settings(const JsonNode& root) {
    if (const JsonNode* node = root.find("variants"); node && expect(*node, JsonKind::array, "'variants'"))
      for (const JsonNode& element : node->elements) read_variant(element);
    check_unique(spec_.variants, "variant");
    if (const JsonNode* node = root.find("ablate")) {
      spec_.ablate = texts(*node, "'ablate'");
      spec_.ablate_where = node->where;
    }
    if (spec_.factorial && spec_.ablate.empty())
      error("missing-key", root.find("factorial")->where, "'factorial' needs 'ablate', the passes to combine");
    if (const JsonNode* node = root.find("sweep"); node && expect(*node, JsonKind::object, "'sweep'"))
      for (const JsonMember& member : node->members) read_axis(member);
    if (const JsonNode* node = root.find("mode"); node && expect(*node, JsonKind::string, "'mode'")) {
      spec_.crossed = node->string == "crossed";
      if (!spec_.crossed && node->string != "one_at_a_time")
        error("unknown-choice", node->where,
              "'mode' is \"crossed\" or \"one_at_a_time\", not " + in_quotes(node->string));
    }
  }

  void read_variant(const JsonNode& node) {
    if (node.kind == JsonKind::string) {
      Changes named;
      named.variants = {node.string};
      spec_.variants.push_back({node.string, std::move(named), node.where});
      return;
    }
    if (node.kind != JsonKind::object)
      return error("wrong-type", node.where,
                   "a variant must be the name of one in the graph, or an object with a 'name' and changes");
    Choice choice;
    choice.where = node.where;
    choice.changes = changes(node, "a variant", kNameKeys);
    read_text(node, "name", choice.name);
    if (choice.name.empty()) error("missing-key", node.where, "a variant needs a 'name'");
    spec_.variants.push_back(std::move(choice));
  }

  void check_unique(const std::vector<Choice>& choices, const std::string& what) {
    std::set<std::string> names;
    for (const Choice& choice : choices)
      if (!names.insert(choice.name).second)
        error("duplicate", choice.where, what + " " + in_quotes(choice.name) + " is listed twice");
  }

  void read_axis(const JsonMember& member) {
    Axis axis{member.key, {}, member.where};
    if (member.value.kind == JsonKind::array) {
      for (const JsonNode& element : member.value.elements)
        if (auto choice = axis_value(member.key, element)) axis.choices.push_back(std::move(*choice));
    } else if (member.value.kind == JsonKind::object) {
      for (const JsonMember& entry : member.value.members)
        axis.choices.push_back({entry.key, changes(entry.value, "a choice of an axis"), entry.where});
    } else {
      return error("wrong-type", member.value.where,
                   "an axis must be a list of values of a param, or an object of named changes");
    }
    if (member.value.elements.empty() && member.value.members.empty())
      error("out-of-range", member.value.where, "axis " + in_quotes(member.key) + " needs at least one value");
    check_unique(axis.choices, "value");
    spec_.sweep.push_back(std::move(axis));
  }

  /// A param's value, or a size, or whether to be general.
  std::optional<Choice> axis_value(const std::string& name, const JsonNode& node) {
    Choice choice;
    choice.where = node.where;
    if (name == "size" || name == "trace_size") {
      const auto read = size(node, "a value of '" + name + "'");
      if (!read) return std::nullopt;
      (name == "size" ? choice.changes.size : choice.changes.trace_size) = read;
      choice.name = size_text(*read);
      return choice;
    }
    if (name == "general") {
      if (!expect(node, JsonKind::boolean, "a value of 'general'")) return std::nullopt;
      choice.changes.general = node.boolean;
      choice.name = node.boolean ? "true" : "false";
      return choice;
    }
    const auto value = scalar(node, "a value of " + in_quotes(name));
    if (!value) return std::nullopt;
    choice.name = *value;
    choice.changes.sets = {{name, *value}};
    return choice;
  }

  void read_reference(const JsonNode& node) {
    if (!expect(node, JsonKind::object, "'reference'")) return;
    ReferenceSpec& reference = spec_.reference;
    reference.where = node.where;
    uint32_t kinds = 0;
    for (const char* key : {"graph", "image", "setting"}) kinds += node.find(key) != nullptr ? 1 : 0;
    if (kinds != 1) return error("missing-key", node.where, "a reference needs one of 'graph', 'image' and 'setting'");
    if (node.find("image") != nullptr) {
      check_keys(node, kReferenceImageKeys, "a reference image");
      reference.kind = ReferenceSpec::Kind::image;
      std::string image;
      read_text(node, "image", image);
      reference.image = path(image).string();
      return;
    }
    if (const JsonNode* setting = node.find("setting")) {
      reference.kind = ReferenceSpec::Kind::setting;
      check_keys(node, joined({kReferenceSettingKeys, kReferenceKeys}), "a reference setting");
      reference.changes = changes(*setting, "'setting'");
    } else {
      reference.kind = ReferenceSpec::Kind::graph;
      reference.changes = changes(node, "a reference graph", joined({kReferenceGraphKeys, kReferenceKeys}));
      std::string graph;
      read_text(node, "graph", graph);
      reference.graph = path(graph);
    }
    read_count(node, "frames", 1, kMostFrames, reference.frames);
    read_count(node, "seed", 0, 0xffffffffU, reference.seed);
    read_flag(node, "average", reference.average);
    if (const JsonNode* match = node.find("match")) reference.match = texts(*match, "'match'");
  }

  void read_metrics(const JsonNode& root) {
    const JsonNode* node = root.find("metrics");
    if (node == nullptr || !expect(*node, JsonKind::array, "'metrics'")) return;
    if (node->elements.empty()) error("out-of-range", node->where, "'metrics' needs at least one name");
    for (const JsonNode& element : node->elements) {
      if (!expect(element, JsonKind::string, "a metric")) continue;
      const std::vector<std::string>& known = metric_names();
      if (std::find(known.begin(), known.end(), element.string) == known.end())
        error("unknown-metric", element.where, "there is no metric " + in_quotes(element.string),
              did_you_mean(element.string, known, "metrics"));
      else if (std::find(spec_.metrics.begin(), spec_.metrics.end(), element.string) != spec_.metrics.end())
        error("duplicate", element.where, "metric " + in_quotes(element.string) + " is listed twice");
      else
        spec_.metrics.push_back(element.string);
    }
  }

  StudySpec spec_;
};

}  // namespace

std::optional<StudySpec> parse_study(std::string_view text, const std::filesystem::path& file,
                                     Diagnostics& diagnostics) {
  const std::optional<JsonNode> root = parse_json(text, file.string(), diagnostics);
  if (!root) return std::nullopt;
  std::optional<StudySpec> spec = StudyReader(file, diagnostics).read(*root);
  return diagnostics.has_errors() ? std::nullopt : spec;
}

}  // namespace lightloom::study
