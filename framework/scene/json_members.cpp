#include "framework/scene/json_members.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
#include "framework/scene/json_scan.hpp"

namespace lightloom::scene {
namespace {

std::string text(double value) {
  std::string result = std::to_string(value);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result;
}

}  // namespace

void refuse_json(const SourceLocation& where, const std::string& sentence, std::string hint) {
  throw Error(ExitCode::invalid_input,
              where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": " + sentence,
              std::move(hint));
}

std::string place_of(const JsonNode& node) {
  return node.where.file + ":" + std::to_string(node.where.line) + ":" + std::to_string(node.where.column);
}

JsonNode parse_json_file(const std::filesystem::path& path, const Limits& limits) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored))
    require_within(limits, &Limits::json_bytes, path.string() + ": the file", std::filesystem::file_size(path));
  const std::string content = read_text_file(path, std::max(limits.json_bytes, kMostTextBytes));
  require_json_within(content, limits, path.string());
  Diagnostics diagnostics;
  std::optional<JsonNode> root = parse_json(content, path.string(), diagnostics, limits.json_values);
  if (diagnostics.has_errors() || !root) {
    const Diagnostic first = diagnostics.sorted().front();
    refuse_json(first.where, first.message, first.hint);
  }
  return std::move(*root);
}

JsonMembers::JsonMembers(const JsonNode& node, std::string name, std::string path)
    : node_(node), name_(std::move(name)), path_(std::move(path)) {
  if (node.kind != JsonKind::object)
    refuse_json(node.where, name_ + " is " + std::string(to_string(node.kind)) + ", expected an object");
}

const JsonNode* JsonMembers::find(const std::string& key) {
  known_.push_back(key);
  return node_.find(key);
}

const JsonNode& JsonMembers::require(const std::string& key) {
  const JsonNode* found = find(key);
  if (!found) refuse_json(node_.where, shown(key) + " is missing");
  return *found;
}

const JsonNode& JsonMembers::typed(const JsonNode& value, const std::string& key, JsonKind kind) const {
  if (value.kind != kind)
    refuse_json(value.where, shown(key) + " is " + std::string(to_string(value.kind)) + ", expected " +
                                 std::string(to_string(kind)));
  return value;
}

double JsonMembers::number(const JsonNode& value, const std::string& key, double min, double max) const {
  if (value.kind != JsonKind::integer && value.kind != JsonKind::real)
    refuse_json(value.where, shown(key) + " is " + std::string(to_string(value.kind)) + ", expected a number");
  if (!std::isfinite(value.real) || value.real < min || value.real > max)
    refuse_json(value.where,
                shown(key) + " is " + text(value.real) + ", expected a value from " + text(min) + " to " + text(max));
  return value.real;
}

double JsonMembers::number_or(const std::string& key, double fallback, double min, double max) {
  const JsonNode* value = find(key);
  return value ? number(*value, key, min, max) : fallback;
}

std::vector<double> JsonMembers::numbers(const JsonNode& value, const std::string& key, size_t count,
                                         double min) const {
  if (value.kind != JsonKind::array || value.elements.size() != count)
    refuse_json(value.where, shown(key) + " is not an array of " + std::to_string(count) + " numbers, expected one");
  std::vector<double> result;
  for (size_t i = 0; i < count; ++i)
    result.push_back(number(value.elements[i], key + "[" + std::to_string(i) + "]", min, kLargest));
  return result;
}

glm::vec3 JsonMembers::vec3(const JsonNode& value, const std::string& key, double min) const {
  const std::vector<double> xyz = numbers(value, key, 3, min);
  return {static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2])};
}

glm::vec3 JsonMembers::vec3_or(const std::string& key, const glm::vec3& fallback, double min) {
  const JsonNode* value = find(key);
  return value ? vec3(*value, key, min) : fallback;
}

void JsonMembers::finish() const {
  for (const JsonMember& member : node_.members) {
    if (std::find(known_.begin(), known_.end(), member.key) == known_.end())
      refuse_json(member.where, shown(member.key) + " is not a known member",
                  did_you_mean(member.key, known_, "known are"));
  }
}

void JsonMembers::finish(KeyTable table) const {
  std::vector<std::string> documented = keys_of(table);
  std::vector<std::string> read = known_;
  std::sort(documented.begin(), documented.end());
  std::sort(read.begin(), read.end());
  if (read != documented) throw std::logic_error(name_ + " is read by other keys than its table has");
  finish();
}

std::string JsonMembers::shown(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

}  // namespace lightloom::scene
