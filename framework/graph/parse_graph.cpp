#include <algorithm>
#include <utility>

#include "framework/base/json.hpp"
#include "framework/base/text.hpp"
#include "framework/graph/graph_keys.hpp"
#include "framework/graph/graph_spec.hpp"

namespace lightloom {
namespace {

/// Turns the JSON tree into a GraphSpec; reports and leaves out what has the wrong form.
class GraphReader {
 public:
  GraphReader(const std::string& file, Diagnostics& diagnostics) : diagnostics_(diagnostics) { spec_.file = file; }

  std::optional<GraphSpec> read(const JsonNode& root) {
    if (!expect(root, JsonKind::object, "a graph file") || !check_version(root)) return std::nullopt;
    check_keys(root, kGraphKeys, "a graph");
    if (const JsonNode* node = root.find("$schema")) read_text(*node, "'$schema'");
    if (const JsonNode* node = root.find("name")) spec_.name = read_text(*node, "'name'").text;
    if (const JsonNode* node = root.find("doc")) read_text(*node, "'doc'");
    if (const JsonNode* node = root.find("view")) read_size(*node, "'view'", spec_.view);
    if (const JsonNode* node = root.find("trace")) read_size(*node, "'trace'", spec_.trace);
    if (const JsonNode* node = root.find("params")) spec_.params = read_scalars(*node, "'params'", true);
    read_required(root, "passes", &GraphReader::read_passes);
    read_required(root, "outputs", &GraphReader::read_outputs);
    if (const JsonNode* node = root.find("variants")) read_variants(*node);
    return std::move(spec_);
  }

 private:
  bool expect(const JsonNode& node, JsonKind kind, const std::string& what) {
    if (node.kind == kind) return true;
    diagnostics_.error(
        "wrong-type", node.where,
        what + " must be " + std::string(to_string(kind)) + ", not " + std::string(to_string(node.kind)));
    return false;
  }

  bool check_version(const JsonNode& root) {
    const JsonNode* version = root.find("lightloom");
    if (version != nullptr && version->kind == JsonKind::integer && version->integer == kGraphFormatVersion)
      return true;
    if (version == nullptr) {
      diagnostics_.error("missing-key", root.where, "this is no graph file: the key 'lightloom' is missing",
                         "begin the file with \"lightloom\": 1");
    } else {
      diagnostics_.error("unknown-version", version->where, "'lightloom' must be 1, the version of the file format");
    }
    return false;
  }

  void check_keys(const JsonNode& object, KeyTable known, const std::string& what) {
    for (const JsonMember& member : object.members) {
      bool found = false;
      for (const KeyDoc& row : known) found = found || row.key == member.key;
      if (!found)
        diagnostics_.error("unknown-key", member.where, what + " has no key " + in_quotes(member.key),
                           did_you_mean(member.key, keys_of(known), "known keys"));
    }
  }

  void check_name(const JsonMember& member, const std::string& what) {
    if (!is_name(member.key))
      diagnostics_.error("bad-name", member.where, in_quotes(member.key) + " cannot be the name of " + what,
                         "names are lower-case letters, digits and '_', and begin with a letter");
  }

  TextSpec read_text(const JsonNode& node, const std::string& what) {
    if (!expect(node, JsonKind::string, what)) return {{}, node.where};
    return {node.string, node.where};
  }

  /// The same, where an empty text would mean nothing.
  TextSpec read_filled(const JsonNode& node, const std::string& what) {
    TextSpec text = read_text(node, what);
    if (node.kind == JsonKind::string && text.text.empty())
      diagnostics_.error("wrong-type", node.where, what + " is an empty text");
    return text;
  }

  void read_required(const JsonNode& root, const std::string& key, void (GraphReader::*reader)(const JsonNode&)) {
    const JsonNode* node = root.find(key);
    if (node != nullptr && !expect(*node, JsonKind::object, "'" + key + "'")) return;
    if (node != nullptr && !node->members.empty()) return (this->*reader)(*node);
    const SourceLocation& where = node != nullptr ? node->where : root.where;
    diagnostics_.error("missing-key", where, "a graph needs at least one entry in '" + key + "'");
  }

  void read_size(const JsonNode& node, const std::string& what, SizeSpec& size) {
    size.where = node.where;
    if (!expect(node, JsonKind::object, what)) return;
    check_keys(node, kSizeKeys, what);
    read_length(node, "width", what, size.width);
    read_length(node, "height", what, size.height);
  }

  void read_length(const JsonNode& object, const std::string& key, const std::string& what, uint32_t& length) {
    const JsonNode* node = object.find(key);
    if (node == nullptr) {
      diagnostics_.error("missing-key", object.where, what + " needs '" + key + "'");
    } else if (expect(*node, JsonKind::integer, "'" + key + "'")) {
      if (node->integer >= 1 && node->integer <= int64_t{kMaximumImageSize}) {
        length = static_cast<uint32_t>(node->integer);
      } else {
        diagnostics_.error("out-of-range", node->where,
                           "'" + key + "' must lie within 1 and " + std::to_string(kMaximumImageSize) +
                               " pixels, not " + std::to_string(node->integer));
      }
    }
  }

  std::vector<ScalarSpec> read_scalars(const JsonNode& node, const std::string& what, bool names) {
    std::vector<ScalarSpec> scalars;
    if (!expect(node, JsonKind::object, what)) return scalars;
    for (const JsonMember& member : node.members) {
      if (names) check_name(member, "a param");
      ScalarSpec scalar{member.key, member.where, {}, member.value.where};
      switch (member.value.kind) {
        case JsonKind::boolean:
          scalar.value = member.value.boolean;
          break;
        case JsonKind::integer:
          scalar.value = member.value.integer;
          break;
        case JsonKind::real:
          scalar.value = member.value.real;
          break;
        case JsonKind::string:
          scalar.value = member.value.string;
          break;
        default:
          diagnostics_.error(
              "wrong-type", member.value.where,
              "a param is a number, a string, true or false, not " + std::string(to_string(member.value.kind)));
          scalar.broken = true;
      }
      scalars.push_back(std::move(scalar));
    }
    return scalars;
  }

  std::vector<FormatSpec> read_formats(const JsonNode& node) {
    std::vector<FormatSpec> formats;
    if (!expect(node, JsonKind::object, "'formats'")) return formats;
    for (const JsonMember& member : node.members)
      if (TextSpec format = read_filled(member.value, "a format"); !format.text.empty())
        formats.push_back({member.key, member.where, std::move(format)});
    return formats;
  }

  EdgeSpec read_edge(const JsonNode& node) {
    EdgeSpec broken;
    broken.where = node.where;
    if (!expect(node, JsonKind::string, "an edge")) return broken;
    EdgeParse parsed = parse_edge(node.string);
    if (!parsed.edge) {
      diagnostics_.error("bad-edge", node.where, "edge " + in_quotes(node.string) + ": " + parsed.problem,
                         "for instance \"trace.radiance\", \"gather.surface.normal\", \"trace.radiance@1..9\"");
      return broken;
    }
    parsed.edge->where = node.where;
    return std::move(*parsed.edge);
  }

  std::vector<ConnectionSpec> read_connections(const JsonNode& node, const std::string& what) {
    std::vector<ConnectionSpec> connections;
    if (!expect(node, JsonKind::object, what)) return connections;
    for (const JsonMember& member : node.members)
      connections.push_back({member.key, member.where, read_edge(member.value)});
    return connections;
  }

  void read_passes(const JsonNode& node) {
    for (const JsonMember& member : node.members) {
      check_name(member, "a pass");
      spec_.passes.push_back(read_pass(member));
    }
  }

  PassSpec read_pass(const JsonMember& member) {
    PassSpec pass;
    pass.name = member.key;
    pass.where = member.where;
    pass.type.where = member.value.where;
    const JsonNode& node = member.value;
    if (!expect(node, JsonKind::object, "a pass")) return pass;
    if (const JsonNode* type = node.find("type")) {
      pass.type = read_filled(*type, "'type'");
    } else {
      diagnostics_.error("missing-key", member.where, "pass " + in_quotes(member.key) + " needs a 'type'");
    }
    if (pass.type.text == kComputeType) {
      check_keys(node, kComputeKeys, "a pass of type 'compute'");
      pass.compute = read_compute(member);
    } else {
      check_keys(node, kPassKeys, "a pass");
    }
    if (const JsonNode* inputs = node.find("in")) pass.inputs = read_connections(*inputs, "'in'");
    if (const JsonNode* params = node.find("params")) pass.params = read_scalars(*params, "'params'", false);
    if (const JsonNode* formats = node.find("formats"); formats != nullptr && !pass.compute)
      pass.formats = read_formats(*formats);
    if (const JsonNode* enabled = node.find("enabled"); enabled && expect(*enabled, JsonKind::boolean, "'enabled'")) {
      pass.enabled = enabled->boolean;
      pass.enabled_where = enabled->where;
    }
    if (const JsonNode* when = node.find("when"); when && expect(*when, JsonKind::string, "'when'"))
      pass.when = TextSpec{when->string, when->where};
    if (const JsonNode* doc = node.find("doc")) pass.doc = read_text(*doc, "'doc'").text;
    return pass;
  }

  ComputeSpec read_compute(const JsonMember& member) {
    ComputeSpec compute;
    if (const JsonNode* shader = member.value.find("shader")) {
      compute.shader = read_filled(*shader, "'shader'");
    } else {
      diagnostics_.error("missing-key", member.where,
                         "pass " + in_quotes(member.key) + " of type 'compute' needs a 'shader'",
                         "\"shader\": \"FILE.comp\", beside the graph file");
    }
    if (const JsonNode* threads = member.value.find("threads")) compute.threads = read_filled(*threads, "'threads'");
    const JsonNode* outputs = member.value.find("out");
    if (outputs == nullptr || !expect(*outputs, JsonKind::object, "'out'")) return compute;
    for (const JsonMember& output : outputs->members) compute.outputs.push_back(read_compute_output(output));
    return compute;
  }

  ComputeOutputSpec read_compute_output(const JsonMember& member) {
    ComputeOutputSpec output;
    output.name = member.key;
    output.name_where = member.where;
    const JsonNode& node = member.value;
    if (!expect(node, JsonKind::object, "an output of a pass")) return output;
    check_keys(node, kComputeOutputKeys, "an output of a pass");
    if (const JsonNode* format = node.find("format")) output.format = read_filled(*format, "'format'");
    if (const JsonNode* size = node.find("size")) output.size = read_filled(*size, "'size'");
    const JsonNode* bypass = node.find("bypass");
    if (bypass != nullptr && bypass->kind == JsonKind::string) {
      output.bypass = TextSpec{bypass->string, bypass->where};
    } else if (bypass != nullptr) {
      output.bypass_constant = read_color(*bypass);
    }
    return output;
  }

  /// A number for all channels, or a list of up to four; what it does not name is 0.
  ClearColor read_color(const JsonNode& node) {
    const auto channel = [](const JsonNode& number) {
      return static_cast<float>(number.kind == JsonKind::integer ? static_cast<double>(number.integer) : number.real);
    };
    const auto is_number = [](const JsonNode& number) {
      return number.kind == JsonKind::integer || number.kind == JsonKind::real;
    };
    ClearColor color{0, 0, 0, 0};
    if (is_number(node)) {
      color.fill(channel(node));
    } else if (node.kind == JsonKind::array && !node.elements.empty() && node.elements.size() <= color.size() &&
               std::all_of(node.elements.begin(), node.elements.end(), is_number)) {
      std::transform(node.elements.begin(), node.elements.end(), color.begin(), channel);
    } else {
      diagnostics_.error("wrong-type", node.where,
                         "'bypass' must be the name of an input, a number, or a list of 1 to 4 numbers");
    }
    return color;
  }

  void read_outputs(const JsonNode& node) {
    for (const JsonMember& member : node.members) check_name(member, "an output");
    spec_.outputs = read_connections(node, "'outputs'");
  }

  void read_variants(const JsonNode& node) {
    if (!expect(node, JsonKind::object, "'variants'")) return;
    for (const JsonMember& member : node.members) {
      check_name(member, "a variant");
      spec_.variants.push_back(read_variant(member));
    }
  }

  VariantSpec read_variant(const JsonMember& member) {
    VariantSpec variant;
    variant.name = member.key;
    variant.where = member.where;
    const JsonNode& node = member.value;
    if (!expect(node, JsonKind::object, "a variant")) return variant;
    check_keys(node, kVariantKeys, "a variant");
    if (const JsonNode* doc = node.find("doc")) variant.doc = read_text(*doc, "'doc'").text;
    if (const JsonNode* disable = node.find("disable"); disable && expect(*disable, JsonKind::array, "'disable'")) {
      for (const JsonNode& element : disable->elements)
        if (expect(element, JsonKind::string, "an entry of 'disable'"))
          variant.disable.push_back({element.string, element.where});
    }
    if (const JsonNode* set = node.find("set")) variant.set = read_scalars(*set, "'set'", false);
    if (const JsonNode* swap = node.find("swap"); swap && expect(*swap, JsonKind::object, "'swap'")) {
      for (const JsonMember& entry : swap->members)
        if (expect(entry.value, JsonKind::string, "a type in 'swap'"))
          variant.swap.push_back({{entry.key, entry.where}, {entry.value.string, entry.value.where}});
    }
    if (const JsonNode* formats = node.find("formats")) variant.formats = read_formats(*formats);
    return variant;
  }

  Diagnostics& diagnostics_;
  GraphSpec spec_;
};

}  // namespace

std::optional<GraphSpec> parse_graph(std::string_view text, const std::string& file_name, Diagnostics& diagnostics) {
  const std::optional<JsonNode> root = parse_json(text, file_name, diagnostics);
  if (!root) return std::nullopt;
  return GraphReader(file_name, diagnostics).read(*root);
}

}  // namespace lightloom
