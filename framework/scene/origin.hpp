#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "framework/scene/source.hpp"

namespace lightloom::scene {

/// Where in the world [m] the coordinates of a scene should have their zero; `source.origin` is not looked at.
///
/// With `snap` the smallest power of two that is not below the longest side of what `draws` draw at time 0, it is the
/// centre of all that, rounded to multiples of `snap`; or the world's own origin if that is less than eight of them
/// away along each axis, where floats still resolve 2^-21 of the scene: coordinates, and so pictures, stay as they are
/// written. A power of two makes what is subtracted exact, and a scene that is moved by multiples of `snap` keeps its
/// bits. Parts of a scene that lie far apart make it large: each then is as coarse as the voxels there are.
[[nodiscard]] glm::dvec3 choose_origin(const SceneSource& source, std::span<const Draw> draws);

/// What to say of a scene nearly all of whose triangles lie in a small part of its bounds, for which most of a voxel
/// grid is wasted: that without the hundredth of the triangles (at least one) that lie farthest out the bounds would be
/// less than a 32nd as long. Empty where that is not so.
[[nodiscard]] std::string far_outlier_warning(const Scene& scene);

}  // namespace lightloom::scene
