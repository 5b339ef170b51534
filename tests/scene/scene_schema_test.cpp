#include "framework/scene/scene_schema.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/base/error.hpp"
#include "framework/scene/scene_file.hpp"
#include "tests/support/schema_check.hpp"

// The published schema of scene files against their reader, which decides by code of its own.
namespace lightloom::scene {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json whole() {
  return Json::parse(R"({
    "$schema": "scene.schema.json", "lightloom_scene": 1, "gltf": "still.gltf",
    "instances": [{"gltf": "a.gltf", "translation": [1, 2, 3], "rotation_y_degrees": 90, "scale": 2,
                   "animation": "Push", "time_offset_seconds": 0.25}],
    "cameras": {"a": {"eye": [0, 5, 0], "target": [0, 0, 0], "up": [1, 0, 0], "vertical_fov_degrees": 90}},
    "sun": {"direction": [0, -2, 0], "irradiance": [1, 2, 3], "angular_radius_degrees": 0.5},
    "environment": {"radiance": [0.5, 0.25, 0.125]}})");
}

/// Each member replaced by each value, and each member left out.
std::vector<std::string> variations() {
  const std::vector<Json> values = {Json(),
                                    true,
                                    "text",
                                    0,
                                    1,
                                    -1,
                                    3.5,
                                    1e13,
                                    Json::array({1, 2}),
                                    Json::array({1, 2, 3}),
                                    Json::array({1, -2, 3}),
                                    Json::array({1, "2", 3}),
                                    Json::object(),
                                    Json{{"unknown", 1}}};
  std::vector<std::string> texts = {whole().dump()};
  std::set<std::string> places;
  const Json flat = whole().flatten();
  for (const auto& [path, value] : flat.items())
    for (Json::json_pointer place(path); !place.empty(); place.pop_back()) places.insert(place.to_string());
  for (const std::string& path : places) {
    Json::json_pointer place(path);
    for (const Json& value : values) {
      Json changed = whole();
      changed[place] = value;
      texts.push_back(changed.dump());
    }
    Json changed = whole();
    const std::string key = place.back();
    place.pop_back();
    if (changed[place].is_object()) changed[place].erase(key);
    texts.push_back(changed.dump());
  }
  return texts;
}

/// What a schema cannot see: vectors that must not be zero or parallel.
bool beyond_schema(const std::string& sentence) {
  for (const char* part : {"the same eye and target", "zero or along the view", "direction is zero"})
    if (sentence.find(part) != std::string::npos) return true;
  return false;
}

TEST(SceneSchema, AcceptsWhatTheReaderAccepts) {
  const lightloom::test::SchemaFolder folder;
  std::vector<fs::path> files;
  for (const std::string& text : variations()) files.push_back(folder.write(std::to_string(files.size()), text));
  const std::vector<std::string> answers = folder.check(folder.write("schema", scene_schema().dump()), files);
  size_t accepted = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    std::string problem;
    try {
      (void)read_scene_file(files[i]);
    } catch (const Error& error) {
      problem = error.what();
    }
    accepted += problem.empty() ? 1 : 0;
    if (beyond_schema(problem)) continue;
    EXPECT_EQ(answers[i], problem.empty() ? "yes" : "no") << read_text_file(files[i]) << "\n" << problem;
  }
  EXPECT_EQ(answers.front(), "yes");
  EXPECT_GT(accepted, 50U);
  EXPECT_GT(files.size(), accepted + 200);
}

TEST(SceneSchema, EnvironmentIsOneOfTwo) {
  const std::vector<std::pair<std::string, std::string>> trials = {
      {R"({"radiance": [1, 1, 1]})", "yes"},
      {R"({"image": "sky.hdr"})", "yes"},
      {R"({"image": "sky.hdr", "scale": 2})", "yes"},
      {R"({"image": "sky.hdr", "scale": -1})", "no"},
      {R"({"radiance": [1, 1, 1], "scale": 2})", "no"},
      {R"({"radiance": [1, 1, 1], "image": "sky.hdr"})", "no"},
      {"{}", "no"},
  };
  const lightloom::test::SchemaFolder folder;
  std::vector<fs::path> files;
  for (const auto& [environment, expected] : trials)
    files.push_back(folder.write(std::to_string(files.size()),
                                 R"({"lightloom_scene": 1, "gltf": "a.glb", "environment": )" + environment + "}"));
  const std::vector<std::string> answers = folder.check(folder.write("schema", scene_schema().dump()), files);
  for (size_t i = 0; i < trials.size(); ++i) EXPECT_EQ(answers[i], trials[i].second) << trials[i].first;
}

TEST(SceneSchema, AcceptsTheScenesThatShip) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source_dir() / "samples/scenes"))
    if (entry.path().string().ends_with(".scene.json")) files.push_back(entry.path());
  ASSERT_GE(files.size(), 1U);
  const lightloom::test::SchemaFolder folder;
  for (const std::string& answer : folder.check(folder.write("schema", scene_schema().dump()), files))
    EXPECT_EQ(answer, "yes");
}

TEST(SceneSchema, AcceptsTheSharedScenes) {
  const fs::path shared = source_dir() / "../shared/scenes";
  if (!fs::exists(shared)) GTEST_SKIP() << "the shared scenes are missing: " << shared;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(shared))
    if (entry.path().string().ends_with(".scene.json")) files.push_back(entry.path());
  ASSERT_GE(files.size(), 1U);
  const lightloom::test::SchemaFolder folder;
  for (const std::string& answer : folder.check(folder.write("schema", scene_schema().dump()), files))
    EXPECT_EQ(answer, "yes");
}

}  // namespace
}  // namespace lightloom::scene
