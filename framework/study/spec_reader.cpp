#include "framework/study/spec_reader.hpp"

#include <algorithm>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/graph/param.hpp"
#include "framework/study/study_keys.hpp"

namespace lightloom::study {

bool SpecReader::expect(const JsonNode& node, JsonKind kind, const std::string& what) {
  if (node.kind == kind) return true;
  error("wrong-type", node.where,
        what + " must be " + std::string(to_string(kind)) + ", not " + std::string(to_string(node.kind)));
  return false;
}

void SpecReader::check_keys(const JsonNode& object, KeyTable table, const std::string& what) {
  const std::vector<std::string> known = keys_of(table);
  for (const JsonMember& member : object.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      error("unknown-key", member.where, what + " has no key " + in_quotes(member.key),
            did_you_mean(member.key, known, "known keys"));
}

void SpecReader::error(const std::string& code, const SourceLocation& where, const std::string& message,
                       const std::string& hint) {
  diagnostics_.error(code, where, message, hint);
}

void SpecReader::read_text(const JsonNode& object, const std::string& key, std::string& value) {
  if (const JsonNode* node = object.find(key); node && expect(*node, JsonKind::string, "'" + key + "'"))
    value = node->string;
}

void SpecReader::read_flag(const JsonNode& object, const std::string& key, bool& value) {
  if (const JsonNode* node = object.find(key); node && expect(*node, JsonKind::boolean, "'" + key + "'"))
    value = node->boolean;
}

void SpecReader::read_count(const JsonNode& object, const std::string& key, uint32_t minimum, uint32_t maximum,
                            uint32_t& value) {
  if (const JsonNode* node = object.find(key)) value = count(*node, "'" + key + "'", minimum, maximum).value_or(value);
}

void SpecReader::read_real(const JsonNode& object, const std::string& key, double minimum, double maximum,
                           double& value) {
  const JsonNode* node = object.find(key);
  if (node == nullptr) return;
  if (node->kind != JsonKind::integer && node->kind != JsonKind::real)
    return error("wrong-type", node->where,
                 "'" + key + "' must be a number, not " + std::string(to_string(node->kind)));
  if (node->real < minimum || node->real > maximum)
    return error(
        "out-of-range", node->where,
        "'" + key + "' must lie within " + to_string(ParamValue(minimum)) + " and " + to_string(ParamValue(maximum)));
  value = node->real;
}

void SpecReader::read_size(const JsonNode& object, const std::string& key, std::optional<Size>& value) {
  if (const JsonNode* node = object.find(key))
    if (auto read = size(*node, "'" + key + "'")) value = read;
}

std::optional<uint32_t> SpecReader::count(const JsonNode& node, const std::string& what, uint32_t minimum,
                                          uint32_t maximum) {
  if (!expect(node, JsonKind::integer, what)) return std::nullopt;
  if (node.integer >= int64_t{minimum} && node.integer <= int64_t{maximum}) return static_cast<uint32_t>(node.integer);
  error("out-of-range", node.where,
        what + " must lie within " + std::to_string(minimum) + " and " + std::to_string(maximum) + ", not " +
            std::to_string(node.integer));
  return std::nullopt;
}

std::optional<Size> SpecReader::size(const JsonNode& node, const std::string& what) {
  if (!expect(node, JsonKind::string, what)) return std::nullopt;
  std::optional<Size> read = parse_size(node.string);
  if (!read)
    error("bad-size", node.where, what + " must be WIDTHxHEIGHT in pixels, not " + in_quotes(node.string),
          "for instance \"320x240\"; both lie within 1 and " + std::to_string(kMaximumImageSize));
  return read;
}

std::vector<std::string> SpecReader::texts(const JsonNode& node, const std::string& what) {
  std::vector<std::string> list;
  if (!expect(node, JsonKind::array, what)) return list;
  for (const JsonNode& element : node.elements)
    if (expect(element, JsonKind::string, "an entry of " + what)) list.push_back(element.string);
  return list;
}

std::optional<std::string> SpecReader::scalar(const JsonNode& node, const std::string& what) {
  switch (node.kind) {
    case JsonKind::boolean:
      return node.boolean ? "true" : "false";
    case JsonKind::integer:
      return std::to_string(node.integer);
    case JsonKind::real:
      return to_string(ParamValue(node.real));
    case JsonKind::string:
      return node.string;
    default:
      error("wrong-type", node.where,
            what + " must be a number, a string, true or false, not " + std::string(to_string(node.kind)));
      return std::nullopt;
  }
}

Changes SpecReader::changes(const JsonNode& object, const std::string& what, KeyTable more) {
  Changes read;
  if (!expect(object, JsonKind::object, what)) return read;
  check_keys(object, joined({more, kChangeKeys}), what);
  if (const JsonNode* node = object.find("variants")) read.variants = texts(*node, "'variants'");
  if (const JsonNode* node = object.find("disable")) read.disables = texts(*node, "'disable'");
  if (const JsonNode* node = object.find("set"); node && expect(*node, JsonKind::object, "'set'"))
    for (const JsonMember& member : node->members)
      if (auto value = scalar(member.value, "param " + in_quotes(member.key)))
        read.sets.emplace_back(member.key, *value);
  if (const JsonNode* node = object.find("swap"); node && expect(*node, JsonKind::object, "'swap'"))
    for (const JsonMember& member : node->members)
      if (expect(member.value, JsonKind::string, "a pass type in 'swap'"))
        read.swaps.emplace_back(member.key, member.value.string);
  if (const JsonNode* node = object.find("formats"); node && expect(*node, JsonKind::object, "'formats'"))
    for (const JsonMember& member : node->members)
      if (expect(member.value, JsonKind::string, "a format"))
        read.formats.emplace_back(member.key, member.value.string);
  read_size(object, "size", read.size);
  read_size(object, "trace_size", read.trace_size);
  if (object.find("general") != nullptr) {
    bool general = false;
    read_flag(object, "general", general);
    read.general = general;
  }
  return read;
}

}  // namespace lightloom::study
