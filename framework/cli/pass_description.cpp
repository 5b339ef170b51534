#include "framework/cli/pass_description.hpp"

#include "framework/base/text.hpp"
#include "framework/cli/argument_values.hpp"
#include "framework/cli/text_layout.hpp"
#include "framework/graph/graph_spec.hpp"

namespace lightloom::cli {
namespace {

constexpr size_t kColumns = 100;
constexpr const char* kOnHost = " Runs on the host.";

std::string first_sentence(const std::string& doc) {
  const size_t end = doc.find(". ");
  return end == std::string::npos ? doc : doc.substr(0, end + 1);
}

std::string_view name_of(Direction direction) {
  switch (direction) {
    case Direction::in:
      return "in";
    case Direction::out:
      return "out";
    case Direction::scratch:
      break;
  }
  return "scratch";
}

std::string_view name_of(ParamType type) {
  switch (type) {
    case ParamType::boolean:
      return "boolean";
    case ParamType::integer:
      return "integer";
    case ParamType::real:
      return "real";
    case ParamType::choice:
      break;
  }
  return "choice";
}

std::string shape_text(const Port& port) {
  const bool formatted = port.direction != Direction::in && port.bundle.empty() && !port.parts.empty();
  std::string text = port.dimension == Dimension::d3 ? "3D" : "2D";
  if (!port.bundle.empty()) text += " " + port.bundle;
  if (formatted) text += " " + std::string(format_info(port.parts.front().format).name);
  return text + ", " + extent_text(port);
}

/// What else there is to know of a port, in words.
std::vector<std::string> port_notes(const Port& port) {
  std::vector<std::string> notes;
  if (port.needed_with)
    notes.emplace_back("optional; with params that do not need it, it counts as unconnected");
  else if (port.optional)
    notes.emplace_back("optional");
  if (port.array) notes.emplace_back("takes a history range @a..b");
  if (!port.exact_format.empty()) notes.push_back("stored as it is: " + port.exact_format);
  if (port.persistent) notes.emplace_back("kept from frame to frame");
  if (port.direction != Direction::out) return notes;
  if (!port.bypass) {
    notes.emplace_back("no bypass");
  } else if (port.bypass->input.empty()) {
    notes.emplace_back("bypass: a constant");
  } else {
    notes.push_back("bypass: " + port.bypass->input);
  }
  return notes;
}

std::string with_notes(const std::string& doc, const std::vector<std::string>& notes) {
  if (notes.empty()) return doc;
  return doc + (doc.empty() ? "(" : " (") + join(notes, "; ") + ")";
}

void describe_ports(const PassType& type, std::string& text) {
  std::vector<std::vector<std::string>> rows;
  for (const Port& port : type.ports) {
    rows.push_back({"  " + std::string(name_of(port.direction)), port.name, shape_text(port)});
  }
  const std::vector<std::string> lines = split(align_columns(rows), '\n');
  text += "\nPorts:\n";
  for (size_t i = 0; i < type.ports.size(); ++i) {
    const Port& port = type.ports[i];
    const std::string doc = with_notes(port.doc, port_notes(port));
    text += lines[i] + "\n";
    if (!doc.empty()) text += "      " + wrap(doc, kColumns, 6, 6) + "\n";
    if (port.bundle.empty()) continue;
    for (const PortPart& part : port.parts) {
      text += "      ." + part.name + " " + wrap(part.doc, kColumns, 10, 8 + part.name.size()) + "\n";
    }
  }
}

void describe_params(const PassType& type, std::string& text) {
  if (type.params.empty()) return;
  text += "\nParams:\n";
  for (const Param& param : type.params) {
    const std::string allowed = allowed_text(param);
    text += "  " + param.name + " = " + to_string(param.default_value) +
            (allowed.empty() ? "" : "  (" + allowed + ")") + "\n      " + wrap(param.doc, kColumns, 6, 6) + "\n";
  }
}

/// Fit for a cell of a Markdown table.
std::string cell(std::string text) {
  for (size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

void write_markdown(const PassType& type, std::string& text) {
  text += "\n## " + type.name + "\n\n" + type.doc + (type.host ? kOnHost : "") +
          "\n\n| port | | shape | what it is |\n| --- | --- | --- | --- |\n";
  for (const Port& port : type.ports) {
    text += "| `" + port.name + "` | " + std::string(name_of(port.direction)) + " | " + shape_text(port) + " | " +
            cell(with_notes(port.doc, port_notes(port))) + " |\n";
  }
  if (type.params.empty()) return;
  text += "\n| param | default | allowed | what it does |\n| --- | --- | --- | --- |\n";
  for (const Param& param : type.params) {
    text += "| `" + param.name + "` | `" + to_string(param.default_value) + "` | " + cell(allowed_text(param)) + " | " +
            cell(param.doc) + " |\n";
  }
}

nlohmann::ordered_json port_json(const Port& port) {
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (const PortPart& part : port.parts) {
    parts.push_back({{"name", part.name}, {"format", format_info(part.format).name}, {"doc", part.doc}});
  }
  nlohmann::ordered_json json = {{"name", port.name},
                                 {"direction", name_of(port.direction)},
                                 {"bundle", port.bundle},
                                 {"dimension", port.dimension == Dimension::d3 ? 3 : 2},
                                 {"extent", extent_text(port)},
                                 {"optional", port.optional},
                                 {"depends_on_params", static_cast<bool>(port.needed_with)},
                                 {"history_range", port.array},
                                 {"persistent", port.persistent},
                                 {"bypass", nullptr},
                                 {"parts", parts},
                                 {"doc", port.doc}};
  if (port.bypass && port.bypass->input.empty()) json["bypass"] = {{"constant", port.bypass->constant}};
  if (port.bypass && !port.bypass->input.empty()) json["bypass"] = {{"input", port.bypass->input}};
  return json;
}

nlohmann::ordered_json param_json(const Param& param) {
  nlohmann::ordered_json json = {{"name", param.name}, {"type", name_of(param.type)}};
  json["default"] = std::visit([](const auto& value) { return nlohmann::ordered_json(value); }, param.default_value);
  if (param.minimum) json["minimum"] = *param.minimum;
  if (param.maximum) json["maximum"] = *param.maximum;
  if (!param.choices.empty()) json["choices"] = param.choices;
  json["unit"] = param.unit;
  json["doc"] = param.doc;
  return json;
}

}  // namespace

std::string extent_text(const Port& port) {
  switch (port.extent) {
    case ExtentRule::any:
      return "any extent";
    case ExtentRule::view:
      return "view size";
    case ExtentRule::trace:
      return "trace size";
    case ExtentRule::grid:
      return "the voxel grid";
    case ExtentRule::fixed:
      return to_string(port.fixed_extent);
    case ExtentRule::like:
      break;
  }
  if (port.times == Extent3{}) return "as large as " + port.like;
  return to_string(port.times) + " times as large as " + port.like;
}

std::string allowed_text(const Param& param) {
  if (!param.choices.empty()) return join(param.choices, " | ");
  std::string text;
  if (param.minimum && param.maximum) {
    text = format_value(*param.minimum) + " to " + format_value(*param.maximum);
  } else if (param.minimum) {
    text = "at least " + format_value(*param.minimum);
  } else if (param.maximum) {
    text = "at most " + format_value(*param.maximum);
  }
  if (param.unit.empty()) return text;
  return text.empty() ? param.unit : text + " " + param.unit;
}

std::string list_passes(const PassRegistry& registry) {
  constexpr size_t kNameColumn = 24;
  std::string text;
  for (const std::string& name : registry.names()) {
    const size_t padding = name.size() < kNameColumn - 1 ? kNameColumn - name.size() : 1;
    text += name + std::string(padding, ' ') +
            wrap(first_sentence(registry.find(name)->doc), kColumns, kNameColumn, kNameColumn) + "\n";
  }
  const std::string compute(kComputeType);
  text += compute + std::string(kNameColumn - compute.size(), ' ') +
          wrap("A GLSL compute shader of one's own, whose names are the ports and params.", kColumns, kNameColumn,
               kNameColumn) +
          "\n";
  return text;
}

std::string describe_pass(const PassType& type) {
  std::string text = type.name + " (version " + std::to_string(type.version) + ")\n\n" +
                     wrap(type.doc + (type.host ? kOnHost : ""), kColumns, 0) + "\n";
  describe_ports(type, text);
  describe_params(type, text);
  return text;
}

std::string passes_markdown(const PassRegistry& registry) {
  std::string text =
      "# Pass types\n\nMade by `lightloom passes --markdown`; do not edit. `lightloom passes TYPE` prints one of them, "
      "`--json` is for programs.\n\nA port is one image, or a bundle of images that travel together (`surface`, "
      "`voxels`). A disabled pass\ngives its bypass in the place of each output; an output without one cannot be "
      "spared.\n\nA pass of type `compute` runs a shader of one's own: [writing_a_pass.md](writing_a_pass.md).\n";
  for (const std::string& name : registry.names()) write_markdown(*registry.find(name), text);
  return text;
}

nlohmann::ordered_json pass_json(const PassType& type) {
  nlohmann::ordered_json ports = nlohmann::ordered_json::array();
  for (const Port& port : type.ports) ports.push_back(port_json(port));
  nlohmann::ordered_json params = nlohmann::ordered_json::array();
  for (const Param& param : type.params) params.push_back(param_json(param));
  return {{"type", type.name}, {"version", type.version}, {"doc", type.doc}, {"host", static_cast<bool>(type.host)},
          {"ports", ports},    {"params", params}};
}

}  // namespace lightloom::cli
