#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/access.hpp"
#include "framework/graph/desc.hpp"
#include "framework/graph/param.hpp"

namespace lightloom {

/// `scratch` is an image that only this pass uses within a frame; it can be dumped like an output, never connected.
enum class Direction : uint8_t { in, out, scratch };

/// One image of a bundle; a plain port has exactly one part with an empty name.
struct PortPart {
  std::string name;
  /// Outputs and scratch: how the image is stored unless the graph says otherwise. Inputs: only its numeric class is
  /// compared, so a shader must do with what comes.
  Format format = Format::rgba16_sfloat;
  std::string doc;
};

/// What replaces an output of a disabled pass: an input port of the same pass (`input`), or, where `input` is empty,
/// an image of the output's own shape, cleared to `constant` once.
struct Bypass {
  std::string input;
  ClearColor constant{0, 0, 0, 0};
};

/// One row of a pass type's port table.
/// Shader names: an input `normal` is bound to `normal`, part `p` of an input bundle `surface` to `surface_p`; outputs
/// are the same with the prefix `out_`; scratch has no prefix. An `array` input (history range) is a `texture2DArray`.
struct Port {
  std::string name;
  Direction direction = Direction::in;
  std::string bundle;  ///< name of the bundle type ("surface", "voxels"); empty for a single image
  std::vector<PortPart> parts;
  Dimension dimension = Dimension::d2;
  ExtentRule extent = ExtentRule::any;
  std::string like;      ///< with ExtentRule::like: the input port whose extent this port has
  Extent3 times;         ///< with ExtentRule::like: how often as large along each axis
  Extent3 fixed_extent;  ///< with ExtentRule::fixed
  Access access = Access::none;
  bool optional = false;  ///< inputs: may be left unconnected
  /// Optional inputs: do these params make the pass read it? Where not, it counts as unconnected, and what only it
  /// needs is culled. Empty: they always do.
  std::function<bool(const ParamSet&)> needed_with;
  bool array = false;  ///< inputs: takes a history range `@a..b`
  /// Outputs and scratch: a frame starts with what the pass left here a frame ago, so that the pass may rewrite a part
  /// of it; PassContext::kept says whether there is something. What is left must not depend on what was there: the
  /// image after a partial rewrite equals, bit for bit, the one a full rewrite would make.
  bool persistent = false;
  std::optional<Bypass> bypass;
  /// Outputs and scratch: why no graph may store it in another format; empty: it may be any of `storage_choices`.
  std::string exact_format;
  std::string doc;
};

}  // namespace lightloom
