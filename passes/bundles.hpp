#pragma once

#include <string>
#include <vector>

#include "framework/graph/port.hpp"

namespace lightloom::passes {

/// The G-buffer: what `gather` sees through each pixel, all in world space.
/// `position.w` is the distance from the viewer along the view axis [m]; 0 marks the background.
/// Reflectance is stored as materials give it; shaders/lib/material.glsl turns it into lobes.
inline std::vector<PortPart> surface_parts() {
  return {
      {"position", Format::rgba32_sfloat, "xyz: position [m]; w: view depth [m], 0 for the background"},
      {"normal", Format::rgba16_sfloat, "xyz: unit shading normal, on the viewer's side; w: 1"},
      {"geometric_normal", Format::rgba16_sfloat, "xyz: unit face normal, on the viewer's side; w: 1 if double sided"},
      {"tangent", Format::rgba16_sfloat,
       "xyz: unit tangent (the direction of roughness x), orthogonal to normal; w: sign of the bitangent"},
      {"albedo", Format::rgba16_sfloat, "rgb: base colour, linear; w: metallic"},
      {"material", Format::rgba16_sfloat, "Ward alpha along the tangent and across it; specular F0; specular F90"},
      {"emission", Format::rgba32_sfloat, "rgb: emitted radiance [W m^-2 sr^-1]; w: 1 if unlit"},
      {"id", Format::rgba32_uint,
       "object id + 1 (0: background); material id; index of the triangle; weights of its corners b and c at the "
       "point, "
       "two 16-bit unorms, b in the low half"},
  };
}

/// The paper's three RGBA8 images of the voxel grid (section 2.1), 16 bits a channel where the graph stores them so;
/// encodings of both in shaders/lib/voxel_encoding.glsl. A
/// voxel has no side: its normal is that of the front face, and a reader turns it to where its ray came from.
inline std::vector<PortPart> voxel_parts() {
  return {
      {"albedo", Format::rgba8_unorm, "rgb: square root of the linear base colour; a: 1 where occupied"},
      {"normal", Format::rgba8_unorm,
       "spherical, y the pole: azimuth * 256 / 2pi, polar angle * 254 / pi; tangent byte (6+2 bits); metallic"},
      {"material", Format::rgba8_unorm,
       "square roots of Ward alpha along the tangent and across it; specular F0 * 4 (0..0.25); emission index / 255"},
  };
}

}  // namespace lightloom::passes
