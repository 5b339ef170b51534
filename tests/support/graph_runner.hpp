#pragma once

#include <string_view>
#include <vector>

#include "framework/graph/pass_type.hpp"
#include "framework/scene/scene.hpp"
#include "framework/stability/lab.hpp"
#include "framework/stability/scenes.hpp"

namespace lightloom::test {

using stability::FrameVisitor;
using stability::Images;
using stability::look_at;
using stability::make_quad_scene;
using stability::QuadSpec;
using stability::white_lambertian;

struct GraphRunOptions : stability::RunOptions {
  /// Pass types on top of the built-in ones, e.g. one that fills an image with a pattern by a shader in
  /// tests/passes/shaders, which is searched after shaders/.
  std::vector<PassType> extra_types = {};
};

/// Runs a graph on the test device (validation on) and shows every frame's images. Diagnostics are thrown as Error
/// with their text.
void visit_frames(std::string_view graph_json, const scene::Scene& scene, const GraphRunOptions& options,
                  const FrameVisitor& visit);

/// Runs a graph on the test device (validation on) and returns every frame's images. Diagnostics are thrown as Error
/// with their text.
std::vector<Images> run_graph(std::string_view graph_json, const scene::Scene& scene,
                              const GraphRunOptions& options = {});

}  // namespace lightloom::test
