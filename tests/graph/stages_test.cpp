// graphs/stages.json is graphs/paper.json with pictures of every stage; nothing else may differ.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom {
namespace {

nlohmann::json graph(const char* name) {
  return nlohmann::json::parse(read_text_file(source_dir() / "graphs" / name));
}

TEST(StagesGraph, HasThePassesOfThePaper) {
  const nlohmann::json paper = graph("paper.json");
  const nlohmann::json stages = graph("stages.json");
  for (const auto& [name, pass] : paper["passes"].items()) {
    ASSERT_TRUE(stages["passes"].contains(name)) << name;
    EXPECT_EQ(stages["passes"][name], pass) << name;
  }
  for (const char* member : {"view", "trace", "params"}) EXPECT_EQ(stages[member], paper[member]) << member;
  for (const auto& [name, output] : paper["outputs"].items()) EXPECT_EQ(stages["outputs"].value(name, ""), output);
}

TEST(StagesGraph, AddsViewsAndToneMapsOnlyAndShowsEachOfThem) {
  const nlohmann::json paper = graph("paper.json");
  const nlohmann::json stages = graph("stages.json");
  size_t views = 0;
  for (const auto& [name, pass] : stages["passes"].items()) {
    if (paper["passes"].contains(name)) continue;
    ++views;
    const std::string type = pass["type"];
    EXPECT_TRUE(type == "view_voxels" || type == "view_surface" || type == "tonemap") << name << " is a " << type;
    bool shown = false;
    for (const auto& [output, value] : stages["outputs"].items()) shown = shown || value == name + ".image";
    EXPECT_TRUE(shown) << name;
  }
  EXPECT_EQ(stages["outputs"].size(), paper["outputs"].size() + views);
}

}  // namespace
}  // namespace lightloom
