#pragma once

#include <string>
#include <utility>
#include <vector>

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
