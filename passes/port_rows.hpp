#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/pass_context.hpp"
#include "framework/graph/port.hpp"
#include "passes/bundles.hpp"

// Shorthand for the rows of a port table. Every image of a compute pass is read by texelFetch and written by
// imageStore.
namespace lightloom::passes {

inline Port image_input(std::string name, Format format, std::string doc) {
  Port port;
  port.name = std::move(name);
  port.direction = Direction::in;
  port.parts = {{"", format, ""}};
  port.access = Access::compute_sampled_read;
  port.doc = std::move(doc);
  return port;
}

/// An image of the last frames, one array layer each.
inline Port history_input(std::string name, Format format, std::string doc) {
  Port port = image_input(std::move(name), format, std::move(doc));
  port.array = true;
  return port;
}

/// One channel of a volume in 8 bits.
inline Port volume_input(std::string name, std::string doc) {
  Port port = image_input(std::move(name), Format::r8_unorm, std::move(doc));
  port.dimension = Dimension::d3;
  return port;
}

inline Port surface_input(std::string name, std::string doc) {
  Port port = image_input(std::move(name), Format::rgba32_sfloat, std::move(doc));
  port.bundle = "surface";
  port.parts = surface_parts();
  return port;
}

inline Port voxels_input(std::string name, std::string doc) {
  Port port = volume_input(std::move(name), std::move(doc));
  port.bundle = "voxels";
  port.parts = voxel_parts();
  return port;
}

/// The same port, for what must be as large as the input `like`.
inline Port same_size_as(std::string like, Port port) {
  port.extent = ExtentRule::like;
  port.like = std::move(like);
  return port;
}

/// The same port, so often as large along each axis as what it is like.
inline Port many_times(const Extent3& times, Port port) {
  port.times = times;
  return port;
}

/// A 2D output as large as the input `like`.
inline Port image_output_like(std::string name, Format format, std::string like, std::string doc) {
  Port port;
  port.name = std::move(name);
  port.direction = Direction::out;
  port.parts = {{"", format, ""}};
  port.extent = ExtentRule::like;
  port.like = std::move(like);
  port.access = Access::compute_storage_write;
  port.doc = std::move(doc);
  return port;
}

/// The same output, replaced by the input `input` where the pass is disabled.
inline Port bypassed_by(std::string input, Port port) {
  port.bypass = Bypass{std::move(input), {}};
  return port;
}

/// The same output, replaced by a constant where the pass is disabled.
inline Port bypassed_by(const ClearColor& constant, Port port) {
  port.bypass = Bypass{"", constant};
  return port;
}

/// The same input, which may be left unconnected; the shader's constant `NAME_bound` tells.
inline Port optional(Port port) {
  port.optional = true;
  return port;
}

/// What a pass records that is one dispatch of `shader`, with a thread for each texel of the output `output`.
inline std::function<void(PassContext&)> one_dispatch(std::string shader, std::string output) {
  return [shader = std::move(shader), output = std::move(output)](PassContext& context) {
    context.dispatch({shader, context.output_extent(output), {}});
  };
}

/// The images of a bundle, made together; the port has the bundle's name.
inline Port bundle_output(std::string bundle, std::vector<PortPart> parts, ExtentRule extent, Access access,
                          std::string doc) {
  Port port;
  port.name = bundle;
  port.direction = Direction::out;
  port.bundle = std::move(bundle);
  port.parts = std::move(parts);
  port.extent = extent;
  port.access = access;
  port.doc = std::move(doc);
  return port;
}

/// One image that a pass needs for itself.
inline Port scratch_image(std::string name, PortPart image, ExtentRule extent, Access access, std::string doc) {
  Port port;
  port.name = std::move(name);
  port.direction = Direction::scratch;
  port.parts = {std::move(image)};
  port.extent = extent;
  port.access = access;
  port.doc = std::move(doc);
  return port;
}

}  // namespace lightloom::passes
