#pragma once

#include "framework/base/limits.hpp"
#include "framework/scene/source.hpp"

namespace lightloom::scene {

/// Bounds of the static geometry and of all poses: each clip is sampled at 30 Hz or finer and at its keys, and the
/// bounds of what moves are padded by 2 % for what lies between. A flat scene gets a thickness. Throws Error if
/// something moves farther than 1e15 m from the origin, or looking would pose more than Limits::posed_elements.
[[nodiscard]] Bounds find_bounds(const Scene& scene, const Limits& limits = {});

/// Scans materials, triangles and lights.
[[nodiscard]] Features find_features(const Scene& scene);

/// A camera outside the scene that sees all of it.
[[nodiscard]] Camera framing_camera(const Bounds& bounds);

/// Whether an image, used as a colour, is black wherever it could emit.
[[nodiscard]] bool is_black(const Image& image);

/// Whether surfaces of this material emit: its factor is not black and its emissive texture, if any, is not either.
[[nodiscard]] bool emits(const Scene& scene, const Material& material);

}  // namespace lightloom::scene
