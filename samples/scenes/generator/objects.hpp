#pragma once

#include "samples/scenes/generator/mesh.hpp"

namespace lightloom::samples {

// What stands in the atrium; each on its own origin, y up from what it stands on [m].

[[nodiscard]] Mesh urn();                                     ///< turned vessel, 1.05 high; tangents around the axis
[[nodiscard]] Mesh plinth(double half_width, double height);  ///< block with a base and a cover plate
[[nodiscard]] Mesh gem();                                     ///< faceted double pyramid about the origin, 0.56 high
[[nodiscard]] Mesh gem_ring();                                ///< tilted ring about the origin, outer radius 0.37
[[nodiscard]] Mesh pot();
[[nodiscard]] Mesh pot_soil();
[[nodiscard]] Mesh fronds();  ///< bent strips for an alpha-masked picture, double-sided
[[nodiscard]] Mesh lamp_housing(double half_width, double height);  ///< on a wall at x = 0 that faces +x
[[nodiscard]] Mesh lamp_panel(double half_width, double height);    ///< the shining face of the housing

}  // namespace lightloom::samples
