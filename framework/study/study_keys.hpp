#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "framework/base/key_table.hpp"

namespace lightloom::study {

// The keys of study files, object by object.

constexpr int64_t kStudyFormatVersion = 1;

constexpr std::array<KeyDoc, 20> kStudyKeys{{
    {"$schema", "Where editors find the schema"},
    {"lightloom_study", "Version of the format"},
    {"name", "The file's name unless given"},
    {"description", "For the report"},
    {"graph", "Graph file"},
    {"scenes", "Scene files; each in its first camera, or in those listed"},
    {"size", "View size, instead of the graph's"},
    {"trace_size", "Size at which is traced, instead of the graph's"},
    {"changes", "Changes to the graph in all settings"},
    {"frames", "Frames of a cell, or how they are used"},
    {"seeds", "How many seeds, from 0 on; or which"},
    {"variants", "Settings one beside the other: variants that the graph declares, or changes with a name"},
    {"ablate", "Patterns of passes to switch off, each alone"},
    {"factorial", "Every combination of the passes of 'ablate' instead"},
    {"sweep", "Axes: values of a param (as --set names it), of size, trace_size or general; or named changes"},
    {"mode", "Every combination of the axes, or one varied at a time"},
    {"reference", "What errors are measured against; the mean of the baseline unless given"},
    {"metrics", "The first one ranks; all of them unless given"},
    {"output", "Output of the graph that is judged"},
    {"jobs", "Cells rendered at the same time"},
}};

constexpr std::array<KeyDoc, 2> kSceneChoiceKeys{{
    {"scene", "Scene file"},
    {"cameras", "Cameras of the scene, by name"},
}};

constexpr std::array<KeyDoc, 5> kFramesKeys{{
    {"count", "Frames of a cell"},
    {"warm_up", "So many at first are not timed"},
    {"first", "Number of the first frame"},
    {"judged", "So many at last are compared with the reference"},
    {"per_second", "Of scene time"},
}};

constexpr std::array<KeyDoc, 8> kChangeKeys{{
    {"variants", "Variants that the graph declares"},
    {"set", "Params by PARAM (the graph's) or PASS.PARAM"},
    {"disable", "Patterns of passes that are off"},
    {"swap", "Other types for passes, by pattern"},
    {"formats", "Formats in which values are stored, by PASS.PORT or PASS.PORT.PART or a pattern, as --store"},
    {"size", "View size"},
    {"trace_size", "Size at which is traced"},
    {"general", "As if the scene had every feature, as --general"},
}};

constexpr std::array<KeyDoc, 1> kNameKeys{{{"name", "What tables call it"}}};

constexpr std::array<KeyDoc, 1> kReferenceImageKeys{
    {{"image", "OpenEXR file; {scene}, {camera}, {size} and {frame} stand for the view's"}}};
constexpr std::array<KeyDoc, 1> kReferenceSettingKeys{{{"setting", "Changes to the study's graph"}}};
constexpr std::array<KeyDoc, 1> kReferenceGraphKeys{{{"graph", "Graph file"}}};
constexpr std::array<KeyDoc, 4> kReferenceKeys{{
    {"frames", "So many are rendered"},
    {"seed", "Of its random numbers"},
    {"average", "Their mean is the reference, not the last of them"},
    {"match", "Params taken over from the setting that is judged"},
}};

[[nodiscard]] inline std::vector<KeyDoc> joined(std::initializer_list<KeyTable> tables) {
  std::vector<KeyDoc> rows;
  for (const KeyTable& table : tables) rows.insert(rows.end(), table.begin(), table.end());
  return rows;
}

}  // namespace lightloom::study
