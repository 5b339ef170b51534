#pragma once

#include <array>
#include <cstdint>

#include "framework/base/key_table.hpp"

namespace lightloom {

// The keys of graph files, object by object.

constexpr int64_t kGraphFormatVersion = 1;

constexpr std::array<KeyDoc, 10> kGraphKeys{{
    {"$schema", "Where editors find the schema"},
    {"lightloom", "Version of the format"},
    {"name", "For people"},
    {"doc", "For people"},
    {"view", "Size of the picture; 1280x960 unless given, `--size` replaces it"},
    {"trace", "Size at which light is traced; 640x480 unless given, `--trace-size` replaces it"},
    {"params", "Params of the graph, which passes take as \"$NAME\"; `--set NAME=VALUE` changes one"},
    {"passes", "The nodes, by name"},
    {"outputs", "What is written each frame, by name: the edge it comes from"},
    {"variants", "Named changes, for `--variant`"},
}};

constexpr std::array<KeyDoc, 2> kSizeKeys{{{"width", "[pixels]"}, {"height", "[pixels]"}}};

constexpr std::array<KeyDoc, 6> kPassKeys{{
    {"type", "Pass type; `lightloom passes` lists them"},
    {"in", "Edges to its inputs: \"pass.port\" or \"pass.port.part\", with @K for the value of K frames ago"},
    {"params", "Its params; those left out have their default"},
    {"enabled", "false: the pass is off, and each of its outputs is replaced by its bypass"},
    {"when", "The pass is off unless the scene has the feature, or, with '!', lacks it"},
    {"doc", "For people"},
}};

constexpr std::array<KeyDoc, 4> kVariantKeys{{
    {"doc", "For people"},
    {"disable", "Passes that are off, by name or pattern ('denoise_*')"},
    {"set", "Params by PARAM (the graph's) or PASS.PARAM, where PASS may be a pattern"},
    {"swap", "Other types for passes, by name or pattern"},
}};

}  // namespace lightloom
