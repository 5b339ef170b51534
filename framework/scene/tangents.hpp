#pragma once

#include "framework/scene/primitive.hpp"

namespace lightloom::scene {

/// Gives each vertex a unit tangent along increasing u, orthogonal to its normal, and the sign of its bitangent.
/// Face tangents are summed with the angle at the corner as weight (Lengyel, "Foundations of Game Engine Development
/// 2", 7.5). A vertex between faces of opposite texture orientation is split in two. Where the texture coordinates give
/// no direction, any orthogonal tangent is taken.
void generate_tangents(Primitive& primitive, uint32_t texcoord);

/// Unshares all corners and gives each the normal of its face.
void make_flat_normals(Primitive& primitive);

}  // namespace lightloom::scene
