#include "framework/cli/new_pass.hpp"

#include <string_view>

namespace lightloom::cli {
namespace {

constexpr std::string_view kCMakeLists = R"(cmake_minimum_required(VERSION 3.25)
project(@NAME@ LANGUAGES CXX)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_package(lightloom 0.1 REQUIRED)
lightloom_add_plugin(@NAME@_pass @NAME@.cpp SHADERS shaders)
)";

constexpr std::string_view kCpp = R"(#include <framework/graph/plugin.hpp>
#include <passes/param_rows.hpp>
#include <passes/port_rows.hpp>

namespace {

using namespace lightloom;
using namespace lightloom::passes;

PassType make_@NAME@() {
  PassType type;
  type.name = "@NAME@";
  type.doc = "Multiplies the picture.";
  // In the shader: `radiance` and `out_radiance`. Disabled, the input stands in for the output.
  type.ports = {image_input("radiance", Format::rgba32_sfloat, "what to multiply"),
                bypassed_by("radiance", image_output_like("radiance", Format::rgba32_sfloat, "radiance", "the product"))};
  // In the shader: a push constant or a specialization constant of this name.
  type.params = {real_param("strength", 0.5, 0, 8, "", "the factor")};
  // Of what changes from frame to frame besides its inputs it reads nothing; FrameState::camera, seed, ... are declared.
  type.reads = FrameState::none;
  type.record = one_dispatch("@NAME@.comp", "radiance");
  return type;
}

}  // namespace

LIGHTLOOM_PLUGIN("@NAME@", "1.0", make_@NAME@())
)";

constexpr std::string_view kShader = R"(#version 460

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D radiance;
uniform writeonly image2D out_radiance;

layout(push_constant) uniform Params {
  float strength;
};

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(radiance, 0)))) return;
  vec4 value = texelFetch(radiance, pixel, 0);
  imageStore(out_radiance, pixel, vec4(strength * value.rgb, value.a));
}
)";

constexpr std::string_view kGraph = R"({
  "lightloom": 1,
  "name": "@NAME@",
  "view": { "width": 640, "height": 480 },
  "passes": {
    "voxelize": { "type": "voxelize", "params": { "geometry": "all", "resolution": 128 } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "gather": { "type": "gather" },
    "trace": {
      "type": "voxel_path_trace",
      "in": { "surface": "gather.surface", "voxels": "voxelize.voxels", "distance": "distance.distance" },
      "params": { "paths": 16 }
    },
    "modulate": { "type": "modulate", "in": { "radiance": "trace.radiance", "surface": "gather.surface" } },
    "@NAME@_pass": {
@NODE@
    },
    "tonemap": { "type": "tonemap", "in": { "radiance": "@NAME@_pass.radiance" } }
  },
  "outputs": { "radiance": "@NAME@_pass.radiance", "image": "tonemap.image" }
}
)";

constexpr std::string_view kPluginNode = R"(      "type": "@NAME@",
      "in": { "radiance": "modulate.radiance" },
      "params": { "strength": 0.5 })";

constexpr std::string_view kComputeNode = R"(      "type": "compute",
      "shader": "@NAME@.comp",
      "in": { "radiance": "modulate.radiance" },
      "out": { "radiance": { "bypass": "radiance" } },
      "params": { "strength": 0.5 })";

constexpr std::string_view kReadme = R"(# @NAME@

`@NAME@.cpp` declares the pass type, `shaders/@NAME@.comp` is what it runs, `@NAME@.json` a graph that uses it.

    cmake -S . -B build -DCMAKE_PREFIX_PATH=WHERE_LIGHTLOOM_IS_INSTALLED && cmake --build build
    lightloom render @NAME@.json --plugin build/@NAME@_pass.so --scene SCENE --out out/@NAME@
)";

/// The template with each `key` replaced.
std::string filled(std::string_view text, const std::string& key, const std::string& value) {
  std::string result(text);
  for (size_t at = result.find(key); at != std::string::npos; at = result.find(key, at + value.size()))
    result.replace(at, key.size(), value);
  return result;
}

std::string named(std::string_view text, const std::string& name) {
  return filled(text, "@NAME@", name);
}

std::string graph(std::string_view node, const std::string& name) {
  return named(filled(kGraph, "@NODE@", std::string(node)), name);
}

}  // namespace

std::vector<NewFile> new_plugin_files(const std::string& name) {
  return {{"CMakeLists.txt", named(kCMakeLists, name)},
          {name + ".cpp", named(kCpp, name)},
          {"shaders/" + name + ".comp", named(kShader, name)},
          {name + ".json", graph(kPluginNode, name)},
          {"README.md", named(kReadme, name)}};
}

std::vector<NewFile> new_compute_files(const std::string& name) {
  return {{name + ".comp", named(kShader, name)}, {name + ".json", graph(kComputeNode, name)}};
}

}  // namespace lightloom::cli
