#pragma once

#include "samples/scenes/generator/mesh.hpp"

namespace lightloom::samples {

// The atrium's measures [m]. x runs along the nave, z across it, the floor is at y = 0.
inline constexpr double kHalfLength = 5.7;  ///< inner face of the end walls
inline constexpr double kHalfWidth = 3.7;   ///< inner face of the side walls
inline constexpr double kHeight = 5.4;      ///< underside of the roof
inline constexpr double kWall = 0.3;        ///< thickness of walls, floor and roof: over three voxels of 128
inline constexpr double kBay = 2.28;        ///< distance of the columns; five bays make the length
inline constexpr double kArcade = 2.4;      ///< centre line of the columns
inline constexpr double kImpost = 2.7;      ///< where the arches spring, on top of the columns
inline constexpr double kArcadeTop = 3.9;   ///< underside of the gallery
inline constexpr double kGalleryFloor = 4.05;
inline constexpr double kOpeningLeft = -2.2, kOpeningRight = 2.6;  ///< roof opening along x
inline constexpr double kOpeningBack = -2.2, kOpeningFront = 1.3;  ///< roof opening along z

[[nodiscard]] Mesh floor_slab();
[[nodiscard]] Mesh roof_slab();  ///< four slabs around the opening
[[nodiscard]] Mesh end_walls();  ///< both, brick
[[nodiscard]] Mesh side_wall();  ///< the one at +z
[[nodiscard]] Mesh beams();      ///< across the nave under the roof

// One side of the colonnade, at +z; the other is this one turned by half a turn.
[[nodiscard]] Mesh column();  ///< on the origin, up to the impost
[[nodiscard]] Mesh arcade();  ///< arches with a raised moulding, and half piers at both ends
[[nodiscard]] Mesh gallery_slab();
[[nodiscard]] Mesh gallery_handrail();
[[nodiscard]] Mesh gallery_grille();  ///< one quad for an alpha-masked picture

}  // namespace lightloom::samples
