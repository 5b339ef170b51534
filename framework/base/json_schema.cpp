#include "framework/base/json_schema.hpp"

#include <stdexcept>
#include <utility>

namespace lightloom {

using Json = nlohmann::ordered_json;

Json schema_document(const std::string& title, const std::string& description, const Json& body) {
  Json document = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}, {"description", description}};
  document.update(body);
  return document;
}

Json object_schema(KeyTable table, SchemaForms forms, const std::vector<std::string>& required) {
  Json properties = Json::object();
  for (const KeyDoc& row : table) {
    const auto form = forms.find(row.key);
    if (form == forms.end()) throw std::logic_error("a schema lacks the form of key '" + std::string(row.key) + "'");
    Json property = {{"description", row.doc}};
    property.update(form->second);
    properties[std::string(row.key)] = std::move(property);
    forms.erase(form);
  }
  if (!forms.empty()) throw std::logic_error("a schema has a form of no key: '" + forms.begin()->first + "'");
  Json object = {{"type", "object"}, {"additionalProperties", false}};
  if (!required.empty()) object["required"] = required;
  object["properties"] = std::move(properties);
  return object;
}

Json schema_reference(const std::string& name) {
  return {{"$ref", "#/$defs/" + name}};
}

Json string_schema(const std::string& pattern) {
  return {{"type", "string"}, {"pattern", pattern}};
}

Json integer_schema(int64_t minimum, int64_t maximum) {
  return {{"type", "integer"}, {"minimum", minimum}, {"maximum", maximum}};
}

}  // namespace lightloom
