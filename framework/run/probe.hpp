#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/render.hpp"

namespace lightloom::run {

/// One call of `lightloom probe`.
struct ProbeRequest {
  RenderRequest render;  ///< as for a render, but for what concerns its run folder
  uint32_t x = 0;        ///< pixel of the view
  uint32_t y = 0;
  bool every = false;  ///< report every frame instead of the last one
};

/// One texel of a value, which stands for the pixel.
struct ProbedTexel {
  std::string port;   ///< of the pass that reads or writes it: "surface.position"
  std::string value;  ///< "pass.port[.part]"
  uint32_t age = 0;
  ImageDesc desc;                     ///< of the whole value
  std::vector<std::string> channels;  ///< names, as in EXR files
  std::string doc;                    ///< what the pass that writes the value says of it
  std::array<uint32_t, 3> place{0, 0, 0};
  std::optional<image::HostImage> texel;  ///< of 1 x 1 x 1
  std::string missing;                    ///< why there is none
};

struct ProbedPass {
  std::string name;
  std::string type;
  std::string once;  ///< GraphPass::once
  std::vector<std::pair<std::string, ParamValue>> params;
  std::vector<ProbedTexel> inputs;
  std::vector<ProbedTexel> outputs;
  std::vector<ProbedTexel> scratch;
};

struct ProbedFrame {
  uint32_t frame = 0;
  double time = 0;              ///< of the scene [s]
  uint32_t history_length = 0;  ///< earlier frames that the histories held
  /// That the pixel sees, in world space less `origin` [m]: where volumes are looked at.
  std::optional<glm::vec3> point;
  glm::dvec3 origin{0};            ///< of the scene, in the world [m]
  std::string point_source;        ///< the value that says so, or why none does
  std::vector<ProbedPass> passes;  ///< in execution order, those that ran once first
};

struct ProbeReport {
  std::string graph;
  Extent3 view;
  std::vector<ProbedFrame> frames;
  std::vector<PassRemark> culled;  ///< they did not run, so their values are not there
  std::vector<PassRemark> bypassed;
  std::vector<std::string> warnings;
};

/// Renders the frames and follows one pixel through the graph: images of the view's size at that pixel, others of two
/// dimensions at the texel that covers the pixel's centre, volumes at the voxel that holds the surface point which the
/// graph's surface position says the pixel sees. One texel of each value comes to the host and nothing else; no pass
/// runs that would not run anyway, except that a reported frame runs twice if the graph has volumes, since the voxel is
/// known only after it. Problems of the graph or the options go to `diagnostics`, and false is returned. Throws
/// Error(usage) for a pixel outside the view, and what a render throws.
bool probe(const ProbeRequest& request, const PassRegistry& registry, const FrameCallback& on_frame,
           Diagnostics& diagnostics, ProbeReport& report);

}  // namespace lightloom::run
