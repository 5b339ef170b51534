#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/base/key_table.hpp"

namespace lightloom {

using SchemaForms = std::map<std::string, nlohmann::ordered_json, std::less<>>;

/// A schema document of JSON Schema 2020-12: its head, then what `body` says.
[[nodiscard]] nlohmann::ordered_json schema_document(const std::string& title, const std::string& description,
                                                     const nlohmann::ordered_json& body);

/// An object with the keys of the table and no others: each has the form of its name, described by the table. Throws
/// std::logic_error unless forms and table have the same keys.
[[nodiscard]] nlohmann::ordered_json object_schema(KeyTable table, SchemaForms forms,
                                                   const std::vector<std::string>& required = {});

/// A reference to a definition of the same document: {"$ref": "#/$defs/NAME"}.
[[nodiscard]] nlohmann::ordered_json schema_reference(const std::string& name);

/// Strings that match; ECMA-262 regular expression, the whole string if it says ^ and $.
[[nodiscard]] nlohmann::ordered_json string_schema(const std::string& pattern);

/// Whole numbers from `minimum` to `maximum`, both included.
[[nodiscard]] nlohmann::ordered_json integer_schema(int64_t minimum, int64_t maximum);

}  // namespace lightloom
