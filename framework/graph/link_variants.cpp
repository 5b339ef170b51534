#include <algorithm>
#include <charconv>
#include <cstddef>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

std::vector<std::string> port_names(const PassType& type, Direction direction) {
  std::vector<std::string> names;
  for (const Port& port : type.ports)
    if (port.direction == direction) names.push_back(port.name);
  return names;
}

std::vector<std::string> param_names(const PassType& type) {
  std::vector<std::string> names;
  for (const Param& param : type.params) names.push_back(param.name);
  return names;
}

/// The text of `--set` as JSON would have it: true, false, an integer, a real; anything else is a string.
ParamValue parse_value(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  const char* end = text.data() + text.size();
  int64_t integer = 0;
  if (const auto result = std::from_chars(text.data(), end, integer); result.ec == std::errc{} && result.ptr == end)
    return integer;
  double real = 0;
  if (const auto result = std::from_chars(text.data(), end, real); result.ec == std::errc{} && result.ptr == end)
    return real;
  return text;
}

bool same_class(const ParamValue& a, const ParamValue& b) {
  const auto number = [](const ParamValue& value) {
    return std::holds_alternative<int64_t>(value) || std::holds_alternative<double>(value);
  };
  return a.index() == b.index() || (number(a) && number(b));
}

std::string_view class_name(const ParamValue& value) {
  if (std::holds_alternative<bool>(value)) return "true or false";
  return std::holds_alternative<std::string>(value) ? "a string" : "a number";
}

/// Applies changes to a set of nodes and reports those that make no sense.
class Editor {
 public:
  Editor(Nodes& nodes, const Input& input, Report& report) : nodes_(nodes), input_(input), report_(report) {}

  void variant(const VariantSpec& variant) {
    const std::string by = "variant '" + variant.name + "'";
    for (const SwapSpec& entry : variant.swap) swap(entry, by);
    for (const TextSpec& glob : variant.disable) disable(glob, by);
    for (const ScalarSpec& entry : variant.set)
      if (!entry.broken) set(entry, {});
    for (const FormatSpec& entry : variant.formats) nodes_.formats.push_back({std::nullopt, entry});
  }

  void options(const LinkOptions& options) {
    for (const auto& [pass, type] : options.swaps) swap({{pass, {"--swap", 0, 0}}, {type, {"--swap", 0, 0}}}, "--swap");
    for (const TypeSet& entry : options.type_sets) set_by_type(entry);
    for (const std::string& glob : options.disables) disable({glob, {"--disable", 0, 0}}, "--disable");
    const SourceLocation where{"--set", 0, 0};
    for (const auto& [name, text] : options.sets) set({name, where, parse_value(text), where}, text);
    const SourceLocation store{"--store", 0, 0};
    for (const auto& [values, format] : options.formats)
      nodes_.formats.push_back({std::nullopt, {values, store, {format, store}}});
  }

 private:
  std::vector<Node*> match(const std::string& glob, const SourceLocation& where) {
    std::vector<Node*> matches;
    if (const auto named = nodes_.by_name.find(glob); named != nodes_.by_name.end())
      return {&nodes_.list[named->second]};
    for (Node& node : nodes_.list)
      if (glob_match(glob, node.spec->name)) matches.push_back(&node);
    if (matches.empty())
      report_.error("no-match", where, in_quotes(glob) + " matches no pass",
                    did_you_mean(glob, nodes_.names(), "passes"));
    return matches;
  }

  void swap(const SwapSpec& entry, const std::string& by) {
    const PassType* type = input_.registry.find(entry.type.text);
    if (entry.type.text == kComputeType)
      report_.error("unknown-pass-type", entry.type.where, "a pass cannot be swapped for type 'compute'",
                    "a pass of type 'compute' has a shader: write it into the graph");
    else if (type == nullptr)
      report_.error("unknown-pass-type", entry.type.where, "there is no pass type " + in_quotes(entry.type.text),
                    did_you_mean(entry.type.text, input_.registry.names(), "pass types"));
    for (Node* node : match(entry.pass.text, entry.pass.where)) {
      node->type = type;
      node->swapped_by = by;
      node->swapped_params.clear();
      for (const ScalarSpec& param : node->params) node->swapped_params.push_back(param.name);
    }
  }

  void disable(const TextSpec& glob, const std::string& by) {
    for (Node* node : match(glob.text, glob.where)) {
      if (!node->enabled()) continue;
      node->disabled = "disabled by " + by + (glob.text == node->spec->name ? "" : " (" + glob.text + ")");
      node->disabled_where = glob.where;
    }
  }

  void set(ScalarSpec entry, const std::optional<std::string>& text) {
    const std::size_t dot = entry.name.rfind('.');
    if (dot == std::string::npos) return set_graph_param(entry, text);
    const std::string glob = entry.name.substr(0, dot);
    entry.name.erase(0, dot + 1);
    set_pass_param(glob, entry, text);
  }

  void set_graph_param(ScalarSpec entry, const std::optional<std::string>& text) {
    std::vector<std::string> names;
    for (ScalarSpec& param : nodes_.graph_params) {
      names.push_back(param.name);
      if (param.name != entry.name) continue;
      if (param.broken) return;
      if (text && std::holds_alternative<std::string>(param.value)) entry.value = *text;
      if (same_class(param.value, entry.value)) {
        param.value = entry.value;
        param.where = entry.where;
      } else {
        report_.error("wrong-type", entry.where,
                      "graph param '" + entry.name + "' is " + std::string(class_name(param.value)) + ", not " +
                          std::string(class_name(entry.value)));
      }
      return;
    }
    report_.error("unknown-graph-param", entry.name_where, "the graph has no param " + in_quotes(entry.name),
                  did_you_mean(entry.name, names, "its params; a pass's own param is PASS.PARAM. Graph params"));
  }

  void set_pass_param(const std::string& glob, const ScalarSpec& entry, const std::optional<std::string>& text) {
    bool found = false;
    std::vector<std::string> names;
    const std::vector<Node*> matches = match(glob, entry.name_where);
    for (Node* node : matches) {
      if (node->type == nullptr) return;
      const Param* param = node->type->find_param(entry.name);
      for (const std::string& name : param_names(*node->type)) names.push_back(name);
      if (param == nullptr) continue;
      found = true;
      ScalarSpec value = entry;
      if (text && param->type == ParamType::choice) value.value = *text;
      std::erase_if(node->params, [&](const ScalarSpec& old) { return old.name == entry.name; });
      std::erase(node->swapped_params, entry.name);
      node->params.push_back(std::move(value));
    }
    if (!found && !matches.empty())
      report_.error("unknown-param", entry.name_where,
                    "pass " + in_quotes(glob) + " of type '" + matches.front()->type->name + "' has no param " +
                        in_quotes(entry.name),
                    did_you_mean(entry.name, names, "its params"));
  }

  void set_by_type(const TypeSet& entry) {
    const SourceLocation where{entry.option, 0, 0};
    bool found = false;
    for (const Node& node : nodes_.list) {
      if (node.type == nullptr || node.type->name != entry.type) continue;
      set_pass_param(node.spec->name, {entry.param, where, parse_value(entry.value), where}, entry.value);
      found = true;
    }
    if (!found)
      report_.error("no-match", where, "the graph has no pass of type '" + entry.type + "'",
                    "put one in the place of another, for instance --swap trace=" + entry.type);
  }

  Nodes& nodes_;
  const Input& input_;
  Report& report_;
};

void check_declared(const Node& node, Report& report) {
  const PassType& type = *node.type;
  const std::string which = "pass '" + node.spec->name + "' of type '" + type.name + "'";
  for (const ScalarSpec& param : node.params)
    if (type.find_param(param.name) == nullptr)
      report.error("unknown-param", param.name_where, which + " has no param " + in_quotes(param.name),
                   did_you_mean(param.name, param_names(type), "its params"));
  for (const ConnectionSpec& connection : node.spec->inputs)
    if (type.find_port(connection.name, Direction::in) == nullptr)
      report.error("unknown-input", connection.name_where, which + " has no input " + in_quotes(connection.name),
                   did_you_mean(connection.name, port_names(type, Direction::in), "its inputs"));
}

/// Is the trace of another size than the view, where passes between the two have something to do?
bool sizes_differ(const Input& input) {
  return wanted_size(input.spec.view, input.options.view) != wanted_size(input.spec.trace, input.options.trace);
}

/// Whether a condition holds, without its '!'; reports one that there is not.
std::optional<bool> holds(std::string_view condition, const TextSpec& when, const Input& input, Report& report) {
  if (condition == kSizesDiffer) return sizes_differ(input);
  constexpr std::string_view kPrefix = "scene.";
  if (!condition.starts_with(kPrefix)) {
    report.error("bad-condition", when.where,
                 "'when' must be \"scene.FEATURE\" or \"" + std::string(kSizesDiffer) +
                     "\", or one of them behind '!', not " + in_quotes(when.text));
    return std::nullopt;
  }
  const std::string_view feature = condition.substr(kPrefix.size());
  std::vector<std::string> names;
  for (const auto& [name, present] : input.environment.scene_features) {
    names.push_back(name);
    if (name == feature) return present;
  }
  report.error("unknown-feature", when.where, "there is no scene feature " + in_quotes(feature),
               did_you_mean(feature, names, "features"));
  return std::nullopt;
}

void apply_when(Node& node, const Input& input, Report& report) {
  const TextSpec& when = *node.spec->when;
  const bool negated = when.text.starts_with('!');
  const std::optional<bool> held = holds(std::string_view(when.text).substr(negated ? 1 : 0), when, input, report);
  if (!held || *held != negated || !node.enabled()) return;
  node.disabled = "\"when\": \"" + when.text + "\" does not hold";
  node.disabled_where = when.where;
}

Nodes nodes_of_file(const Input& input, Report& report) {
  Nodes nodes;
  nodes.graph_params = input.spec.params;
  for (const PassSpec& spec : input.spec.passes) {
    nodes.by_name.emplace(spec.name, static_cast<uint32_t>(nodes.list.size()));
    Node& node = nodes.list.emplace_back();
    node.spec = &spec;
    node.params = spec.params;
    for (const FormatSpec& format : spec.formats)
      nodes.formats.push_back({static_cast<uint32_t>(nodes.list.size() - 1), format});
    if (!spec.enabled) {
      node.disabled = "\"enabled\": false";
      node.disabled_where = spec.enabled_where;
    }
    if (spec.when) apply_when(node, input, report);
    if (spec.type.text.empty()) continue;
    node.type = type_in_file(spec, input.registry);
    if (node.type != nullptr) {
      check_declared(node, report);
    } else if (!spec.compute) {
      std::vector<std::string> names = input.registry.names();
      names.emplace_back(kComputeType);
      report.error("unknown-pass-type", spec.type.where, "there is no pass type " + in_quotes(spec.type.text),
                   did_you_mean(spec.type.text, names, "pass types"));
    } else if (!report.has_errors()) {
      report.error("shader-error", spec.type.where, "the shader of pass '" + spec.name + "' was not compiled");
    }
  }
  return nodes;
}

}  // namespace

Nodes make_nodes(const Input& input, Report& report, std::vector<std::string>& notes) {
  Nodes nodes = nodes_of_file(input, report);
  std::vector<std::string> names;
  // Every variant is tried alone, so that its mistakes show even if nobody asks for it now.
  for (const VariantSpec& variant : input.spec.variants) {
    names.push_back(variant.name);
    Nodes tried = nodes;
    Editor(tried, input, report).variant(variant);
    std::vector<std::string> unsaid;
    for (Node& node : tried.list) drop_misfits(node, tried, input.registry, unsaid);
    resolve_params(tried, report);
    resolve_formats(tried, report, unsaid);
  }
  Editor editor(nodes, input, report);
  for (const std::string& wanted : input.options.variants) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) {
      report.error("unknown-variant", {"--variant", 0, 0}, "the graph has no variant " + in_quotes(wanted),
                   did_you_mean(wanted, names, "variants"));
    } else {
      editor.variant(input.spec.variants[static_cast<std::size_t>(found - names.begin())]);
    }
  }
  editor.options(input.options);
  for (Node& node : nodes.list) drop_misfits(node, nodes, input.registry, notes);
  return nodes;
}

}  // namespace lightloom::linking
