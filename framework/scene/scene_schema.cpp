#include "framework/scene/scene_schema.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/json_schema.hpp"
#include "framework/scene/scene_keys.hpp"

namespace lightloom::scene {
namespace {

using Json = nlohmann::ordered_json;

Json text_schema() {
  return {{"type", "string"}};
}

Json number_schema(const NumberRange& range) {
  return {{"type", "number"}, {"minimum", range.minimum}, {"maximum", range.maximum}, {"default", range.fallback}};
}

Json vector_schema(double minimum) {
  return {{"type", "array"},
          {"minItems", 3},
          {"maxItems", 3},
          {"items", {{"type", "number"}, {"minimum", minimum}, {"maximum", JsonMembers::kLargest}}}};
}

Json point_schema() {
  return vector_schema(-JsonMembers::kLargest);
}

Json color_schema() {
  return vector_schema(0);
}

Json with_default(Json form, const Json& fallback) {
  form["default"] = fallback;
  return form;
}

Json instance_schema() {
  const Json animation = {{"anyOf", Json::array({integer_schema(0, kMostAnimations - 1), text_schema()})},
                          {"default", 0}};
  return object_schema(kInstanceKeys,
                       {{"gltf", text_schema()},
                        {"translation", with_default(point_schema(), {0, 0, 0})},
                        {"rotation_y_degrees", number_schema(kInstanceRotation)},
                        {"scale", number_schema(kInstanceScale)},
                        {"time_offset_seconds", number_schema(kTimeOffset)},
                        {"animation", animation}},
                       {"gltf"});
}

Json camera_schema() {
  return object_schema(kCameraKeys,
                       {{"eye", point_schema()},
                        {"target", point_schema()},
                        {"up", with_default(point_schema(), {0, 1, 0})},
                        {"vertical_fov_degrees", number_schema(kFieldOfView)}},
                       {"eye", "target"});
}

Json sun_schema() {
  return object_schema(kSunKeys,
                       {{"direction", point_schema()},
                        {"irradiance", color_schema()},
                        {"angular_radius_degrees", number_schema(kSunRadius)}},
                       {"direction", "irradiance"});
}

/// One of radiance and image; a scale goes with an image.
Json environment_schema() {
  Json schema = object_schema(
      kEnvironmentKeys,
      {{"radiance", color_schema()}, {"image", text_schema()}, {"scale", number_schema(kEnvironmentScale)}});
  schema["oneOf"] = Json::array({{{"required", {"radiance"}}}, {{"required", {"image"}}}});
  schema["dependentRequired"] = {{"scale", {"image"}}};
  return schema;
}

}  // namespace

Json scene_schema() {
  Json body = object_schema(kSceneKeys,
                            {{"$schema", text_schema()},
                             {"lightloom_scene", {{"const", kSceneFormatVersion}}},
                             {"gltf", text_schema()},
                             {"instances", {{"type", "array"}, {"items", schema_reference("instance")}}},
                             {"cameras", {{"type", "object"}, {"additionalProperties", schema_reference("camera")}}},
                             {"sun", schema_reference("sun")},
                             {"environment", schema_reference("environment")}},
                            {"lightloom_scene", "gltf"});
  body["$defs"] = {{"instance", instance_schema()},
                   {"camera", camera_schema()},
                   {"sun", sun_schema()},
                   {"environment", environment_schema()}};
  return schema_document(
      "Lightloom scene",
      "A scene around glTF files. Made by `lightloom schema scene`; docs/scene_files.md explains it.", body);
}

}  // namespace lightloom::scene
