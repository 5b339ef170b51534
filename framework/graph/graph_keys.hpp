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

constexpr std::array<KeyDoc, 7> kPassKeys{{
    {"type", "Pass type; `lightloom passes` lists them"},
    {"in", "Edges to its inputs: \"pass.port\" or \"pass.port.part\", with @K for the value of K frames ago"},
    {"params", "Its params; those left out have their default"},
    {"formats", "How its outputs are stored, by PORT or PORT.PART; those left out as its type says"},
    {"enabled", "false: the pass is off, and each of its outputs is replaced by its bypass"},
    {"when", "The pass is off unless the scene has the feature (or the sizes differ), or, with '!', lacks it"},
    {"doc", "For people"},
}};

/// Of a pass of type `compute`.
constexpr std::array<KeyDoc, 9> kComputeKeys{{
    {"type", "compute: a GLSL compute shader of one's own; names in it are its ports and params"},
    {"shader", "File *.comp, beside the graph file, else in the shader folders"},
    {"in", "Edges to its inputs: the textures that the shader reads, bundles as BUNDLE_PART"},
    {"out", "What the shader does not say of its outputs, the images out_NAME that it writes"},
    {"threads", "Output that has a thread for each texel; the first unless given"},
    {"params", "Its params: values of the shader's push constants and specialization constants"},
    {"enabled", "false: the pass is off, and each of its outputs is replaced by its bypass"},
    {"when", "The pass is off unless the scene has the feature (or the sizes differ), or, with '!', lacks it"},
    {"doc", "For people"},
}};

constexpr std::array<KeyDoc, 3> kComputeOutputKeys{{
    {"format", "Unless the shader names one: rgba32_sfloat where not given"},
    {"size",
     "\"view\", \"trace\", \"grid\", \"like INPUT\", \"640x480\" or \"64x64x64\"; that of an input unless given"},
    {"bypass", "What replaces it where the pass is off: an input, or a constant"},
}};

constexpr std::array<KeyDoc, 5> kVariantKeys{{
    {"doc", "For people"},
    {"disable", "Passes that are off, by name or pattern ('denoise_*')"},
    {"set", "Params by PARAM (the graph's) or PASS.PARAM, where PASS may be a pattern"},
    {"swap", "Other types for passes, by name or pattern"},
    {"formats", "How values are stored, by PASS.PORT or PASS.PORT.PART, or a pattern ('*.radiance')"},
}};

}  // namespace lightloom
