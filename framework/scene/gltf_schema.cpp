#include "framework/scene/gltf_schema.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "framework/scene/fail.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;

enum class Kind {
  boolean,
  integer,
  number,
  string,
  choice,          ///< string or integer out of `choices`
  numbers,         ///< array of `count` numbers; 0: any length
  strings,         ///< array of strings
  index,           ///< into the array at `pointer`
  indices,         ///< array of them
  attributes,      ///< object whose values are indices
  attribute_list,  ///< array of such objects
  object,          ///< of `type`
  objects,         ///< array of `type`
};

struct ObjectType;

struct Field {
  std::string_view name;
  Kind kind = Kind::object;
  bool required = false;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  size_t count = 0;
  std::string_view choices = {};     ///< "|A|B|"
  const char* pointer = nullptr;     ///< JSON pointer of the array that indices go into
  const ObjectType* type = nullptr;  ///< of the members of object and objects
};

struct ObjectType {
  std::vector<Field> fields;
};

constexpr bool kRequired = true;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMaxInteger = 2147483647.0;
constexpr double kMaxByteSize = 9007199254740992.0;
constexpr const char* kLights = "/extensions/KHR_lights_punctual/lights";

Field index_of(std::string_view name, const char* pointer, bool required = false) {
  return {.name = name, .kind = Kind::index, .required = required, .pointer = pointer};
}
Field indices_of(std::string_view name, const char* pointer, bool required = false) {
  return {.name = name, .kind = Kind::indices, .required = required, .pointer = pointer};
}
Field number(std::string_view name, double min = -kInfinity, double max = kInfinity, bool required = false) {
  return {.name = name, .kind = Kind::number, .required = required, .min = min, .max = max};
}
Field numbers(std::string_view name, size_t count, double min = -kInfinity, double max = kInfinity) {
  return {.name = name, .kind = Kind::numbers, .min = min, .max = max, .count = count};
}
Field integer(std::string_view name, double min, double max, bool required = false) {
  return {.name = name, .kind = Kind::integer, .required = required, .min = min, .max = max};
}
Field choice(std::string_view name, std::string_view choices, bool required = false) {
  return {.name = name, .kind = Kind::choice, .required = required, .choices = choices};
}
Field text(std::string_view name, bool required = false) {
  return {.name = name, .kind = Kind::string, .required = required};
}
Field object(std::string_view name, const ObjectType& type, bool required = false) {
  return {.name = name, .kind = Kind::object, .required = required, .type = &type};
}
Field objects(std::string_view name, const ObjectType& type, bool required = false) {
  return {.name = name, .kind = Kind::objects, .required = required, .type = &type};
}
Field boolean(std::string_view name) {
  return {.name = name, .kind = Kind::boolean};
}

const ObjectType& texture_info_type() {
  static const ObjectType transform{
      {numbers("offset", 2), number("rotation"), numbers("scale", 2), integer("texCoord", 0, kMaxInteger)}};
  static const ObjectType extensions{{object("KHR_texture_transform", transform)}};
  static const ObjectType type{{index_of("index", "/textures", kRequired), integer("texCoord", 0, kMaxInteger),
                                number("scale"), number("strength"), object("extensions", extensions)}};
  return type;
}

const ObjectType& material_extensions_type() {
  const ObjectType& texture = texture_info_type();
  static const ObjectType anisotropy{
      {number("anisotropyStrength", 0, 1), number("anisotropyRotation"), object("anisotropyTexture", texture)}};
  static const ObjectType emissive{{number("emissiveStrength", 0)}};
  static const ObjectType specular{{number("specularFactor", 0, 1), object("specularTexture", texture),
                                    numbers("specularColorFactor", 3, 0), object("specularColorTexture", texture)}};
  static const ObjectType ior{{number("ior", 0)}};
  static const ObjectType transmission{{number("transmissionFactor", 0, 1), object("transmissionTexture", texture)}};
  static const ObjectType unlit{};
  static const ObjectType type{
      {object("KHR_materials_anisotropy", anisotropy), object("KHR_materials_emissive_strength", emissive),
       object("KHR_materials_specular", specular), object("KHR_materials_ior", ior),
       object("KHR_materials_transmission", transmission), object("KHR_materials_unlit", unlit)}};
  return type;
}

const ObjectType& material_type() {
  const ObjectType& texture = texture_info_type();
  static const ObjectType pbr{{numbers("baseColorFactor", 4, 0, 1), object("baseColorTexture", texture),
                               number("metallicFactor", 0, 1), number("roughnessFactor", 0, 1),
                               object("metallicRoughnessTexture", texture)}};
  static const ObjectType type{{text("name"), object("pbrMetallicRoughness", pbr), object("normalTexture", texture),
                                object("occlusionTexture", texture), object("emissiveTexture", texture),
                                numbers("emissiveFactor", 3, 0), choice("alphaMode", "|OPAQUE|MASK|BLEND|"),
                                number("alphaCutoff", 0), boolean("doubleSided"),
                                object("extensions", material_extensions_type())}};
  return type;
}

const ObjectType& accessor_type() {
  static const ObjectType sparse_indices{{index_of("bufferView", "/bufferViews", kRequired),
                                          integer("byteOffset", 0, kMaxInteger),
                                          choice("componentType", "|5121|5123|5125|", kRequired)}};
  static const ObjectType sparse_values{
      {index_of("bufferView", "/bufferViews", kRequired), integer("byteOffset", 0, kMaxInteger)}};
  static const ObjectType sparse{{integer("count", 1, kMaxInteger, kRequired),
                                  object("indices", sparse_indices, kRequired),
                                  object("values", sparse_values, kRequired)}};
  static const ObjectType type{{index_of("bufferView", "/bufferViews"), integer("byteOffset", 0, kMaxByteSize),
                                choice("componentType", "|5120|5121|5122|5123|5125|5126|", kRequired),
                                boolean("normalized"), integer("count", 1, kMaxInteger, kRequired),
                                choice("type", "|SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4|", kRequired),
                                object("sparse", sparse)}};
  return type;
}

const ObjectType& mesh_type() {
  static const ObjectType primitive{
      {{.name = "attributes", .kind = Kind::attributes, .required = kRequired, .pointer = "/accessors"},
       {.name = "targets", .kind = Kind::attribute_list, .pointer = "/accessors"},
       index_of("indices", "/accessors"),
       index_of("material", "/materials"),
       integer("mode", 0, 6)}};
  static const ObjectType type{{text("name"), objects("primitives", primitive, kRequired), numbers("weights", 0)}};
  return type;
}

const ObjectType& node_type() {
  static const ObjectType light{{index_of("light", kLights, kRequired)}};
  static const ObjectType extensions{{object("KHR_lights_punctual", light)}};
  static const ObjectType type{{text("name"), index_of("camera", "/cameras"), indices_of("children", "/nodes"),
                                index_of("skin", "/skins"), index_of("mesh", "/meshes"), numbers("matrix", 16),
                                numbers("rotation", 4), numbers("scale", 3), numbers("translation", 3),
                                numbers("weights", 0), object("extensions", extensions)}};
  return type;
}

const ObjectType& animation_type() {
  static const ObjectType target{
      {index_of("node", "/nodes"), choice("path", "|translation|rotation|scale|weights|", kRequired)}};
  static const ObjectType channel{{integer("sampler", 0, kMaxInteger, kRequired), object("target", target, kRequired)}};
  static const ObjectType sampler{{index_of("input", "/accessors", kRequired),
                                   choice("interpolation", "|LINEAR|STEP|CUBICSPLINE|"),
                                   index_of("output", "/accessors", kRequired)}};
  static const ObjectType type{
      {text("name"), objects("channels", channel, kRequired), objects("samplers", sampler, kRequired)}};
  return type;
}

const ObjectType& camera_type() {
  static const ObjectType perspective{{number("yfov", 1e-4, 3.1415, kRequired), number("znear", 0, kInfinity, true)}};
  static const ObjectType orthographic{{number("xmag", -kInfinity, kInfinity, kRequired),
                                        number("ymag", -kInfinity, kInfinity, kRequired),
                                        number("zfar", 0, kInfinity, true), number("znear", 0, kInfinity, true)}};
  static const ObjectType type{{text("name"), choice("type", "|perspective|orthographic|", kRequired),
                                object("perspective", perspective), object("orthographic", orthographic)}};
  return type;
}

const ObjectType& extensions_type() {
  static const ObjectType spot{{number("innerConeAngle", 0, 1.5707964), number("outerConeAngle", 1e-4, 1.5707964)}};
  static const ObjectType light{{text("name"), choice("type", "|point|spot|directional|", kRequired),
                                 numbers("color", 3, 0), number("intensity", 0), number("range", 0),
                                 object("spot", spot)}};
  static const ObjectType lights{{objects("lights", light, kRequired)}};
  static const ObjectType type{{object("KHR_lights_punctual", lights)}};
  return type;
}

const ObjectType& document_type() {
  static const ObjectType asset{{text("version", kRequired), text("minVersion")}};
  static const ObjectType scene{{text("name"), indices_of("nodes", "/nodes")}};
  static const ObjectType skin{{text("name"), index_of("inverseBindMatrices", "/accessors"),
                                index_of("skeleton", "/nodes"), indices_of("joints", "/nodes", kRequired)}};
  static const ObjectType texture{{index_of("sampler", "/samplers"), index_of("source", "/images")}};
  static const ObjectType image{{text("name"), text("uri"), text("mimeType"), index_of("bufferView", "/bufferViews")}};
  static const ObjectType sampler{{choice("magFilter", "|9728|9729|"),
                                   choice("minFilter", "|9728|9729|9984|9985|9986|9987|"),
                                   choice("wrapS", "|33071|33648|10497|"), choice("wrapT", "|33071|33648|10497|")}};
  static const ObjectType buffer{{text("uri"), integer("byteLength", 1, kMaxByteSize, kRequired)}};
  static const ObjectType view{{index_of("buffer", "/buffers", kRequired), integer("byteOffset", 0, kMaxByteSize),
                                integer("byteLength", 1, kMaxByteSize, kRequired), integer("byteStride", 4, 252)}};
  static const Field used{.name = "extensionsUsed", .kind = Kind::strings};
  static const Field required{.name = "extensionsRequired", .kind = Kind::strings};
  static const ObjectType type{{object("asset", asset, kRequired), used, required, index_of("scene", "/scenes"),
                                objects("scenes", scene), objects("nodes", node_type()), objects("meshes", mesh_type()),
                                objects("accessors", accessor_type()), objects("bufferViews", view),
                                objects("buffers", buffer), objects("materials", material_type()),
                                objects("textures", texture), objects("images", image), objects("samplers", sampler),
                                objects("skins", skin), objects("cameras", camera_type()),
                                objects("animations", animation_type()), object("extensions", extensions_type())}};
  return type;
}

class Checker {
 public:
  Checker(const json& document, const Limits& limits, const std::string& file)
      : document_(document), limits_(limits), file_(file) {}

  void check_object(const json& value, const ObjectType& type, const std::string& path) const {
    if (!value.is_object()) refuse(path, value, "an object");
    for (const Field& field : type.fields) {
      const std::string member = path.empty() ? std::string(field.name) : path + "." + std::string(field.name);
      const auto found = value.find(std::string(field.name));
      if (found != value.end()) {
        check_field(*found, field, member);
      } else if (field.required) {
        fail(file_, member, "is missing, which glTF requires");
      }
    }
  }

 private:
  void check_field(const json& value, const Field& field, const std::string& path) const {
    switch (field.kind) {
      case Kind::boolean:
        if (!value.is_boolean()) refuse(path, value, "true or false");
        return;
      case Kind::string:
        if (!value.is_string()) refuse(path, value, "a string");
        if (field.name == "name")
          require_within(limits_, &Limits::name_bytes, file_ + ": " + path, value.get_ref<const std::string&>().size());
        return;
      case Kind::choice:
        return check_choice(value, field, path);
      case Kind::integer:
      case Kind::number:
        return check_number(value, field, path);
      case Kind::index:
        return check_index(value, field, path);
      case Kind::object:
        return check_object(value, *field.type, path);
      case Kind::attributes:
        return check_attributes(value, field, path);
      case Kind::numbers:
      case Kind::strings:
      case Kind::indices:
      case Kind::attribute_list:
      case Kind::objects:
        return check_array(value, field, path);
    }
  }

  void check_choice(const json& value, const Field& field, const std::string& path) const {
    const std::string found = value.is_string()           ? value.get<std::string>()
                              : value.is_number_integer() ? value.dump()
                                                          : std::string();
    if (found.empty() || field.choices.find("|" + found + "|") == std::string_view::npos) {
      std::string list;
      for (const char c : field.choices.substr(1, field.choices.size() - 2))
        list += c == '|' ? ", " : std::string(1, c);
      refuse(path, value, "one of " + list);
    }
  }

  void check_number(const json& value, const Field& field, const std::string& path) const {
    const bool integral = field.kind == Kind::integer;
    if (!value.is_number()) refuse(path, value, integral ? "an integer" : "a number");
    const double number_value = value.get<double>();
    if (!std::isfinite(number_value) || (integral && !value.is_number_integer())) {
      refuse(path, value, integral ? "an integer" : "a finite number");
    }
    if (number_value < field.min || number_value > field.max) {
      std::string range = "a value";
      if (field.min > -kInfinity) range += " of at least " + shown(field.min);
      if (field.max < kMaxInteger)
        range += (field.min > -kInfinity ? " and at most " : " of at most ") + shown(field.max);
      if (number_value > field.max && field.max >= kMaxInteger) range += " that fits";
      refuse(path, value, range);
    }
  }

  void check_index(const json& value, const Field& field, const std::string& path) const {
    const json::json_pointer pointer(field.pointer);
    const size_t size = document_.contains(pointer) && document_[pointer].is_array() ? document_[pointer].size() : 0;
    const std::string array = std::string(field.pointer).substr(std::string(field.pointer).rfind('/') + 1);
    const bool valid =
        value.is_number_integer() && value.get<double>() >= 0 && value.get<double>() < static_cast<double>(size);
    if (!valid) {
      refuse(path, value,
             "an index into " + array + ", which has " + std::to_string(size) + " element" + (size == 1 ? "" : "s"));
    }
  }

  void check_attributes(const json& value, const Field& field, const std::string& path) const {
    if (!value.is_object()) refuse(path, value, "an object");
    for (const auto& [name, index] : value.items()) check_index(index, field, path + "." + name);
  }

  void check_array(const json& value, const Field& field, const std::string& path) const {
    if (!value.is_array()) refuse(path, value, "an array");
    if (field.count != 0 && value.size() != field.count) {
      refuse(path, value, "an array of " + std::to_string(field.count) + " numbers");
    }
    if (field.required && value.empty()) refuse(path, value, "a non-empty array");
    Field element = field;
    element.kind = field.kind == Kind::numbers          ? Kind::number
                   : field.kind == Kind::strings        ? Kind::string
                   : field.kind == Kind::indices        ? Kind::index
                   : field.kind == Kind::attribute_list ? Kind::attributes
                                                        : Kind::object;
    for (size_t i = 0; i < value.size(); ++i) check_field(value[i], element, path + "[" + std::to_string(i) + "]");
  }

  static std::string shown(double number_value) {
    const bool integral = number_value == std::floor(number_value) && std::abs(number_value) < 1e6;
    return integral ? std::to_string(static_cast<long>(number_value)) : json(number_value).dump();
  }

  [[noreturn]] void refuse(const std::string& path, const json& value, const std::string& expected) const {
    std::string shown = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (shown.size() > 60) shown = shown.substr(0, 57) + "...";
    fail(file_, path.empty() ? "the document" : path, "is " + shown + ", expected " + expected);
  }

  const json& document_;
  const Limits& limits_;
  const std::string& file_;
};

}  // namespace

void check_gltf_json(const nlohmann::json& document, const Limits& limits, const std::string& file) {
  // Arrays first: an index into something that is no array is best explained by that.
  for (const Field& field : document_type().fields) {
    const bool wrong = field.kind == Kind::objects && document.is_object() &&
                       document.contains(std::string(field.name)) && !document[std::string(field.name)].is_array();
    if (wrong)
      fail(file, std::string(field.name),
           "is " + std::string(document[std::string(field.name)].type_name()) + ", expected an array");
  }
  Checker(document, limits, file).check_object(document, document_type(), "");
}

void normalise_numbers(nlohmann::json& document, bool in_extension) {
  if (document.is_number_float()) {
    const double value = document.get<double>();
    if (std::abs(value) <= kMaxInteger && value == std::floor(value)) document = static_cast<int64_t>(value);
  } else if (document.is_number_integer() && in_extension && std::abs(document.get<double>()) > kMaxInteger) {
    document = document.get<double>();
  } else if (document.is_object()) {
    for (auto& [key, value] : document.items()) normalise_numbers(value, in_extension || key == "extensions");
  } else if (document.is_array()) {
    for (nlohmann::json& value : document) normalise_numbers(value, in_extension);
  }
}

}  // namespace lightloom::scene
