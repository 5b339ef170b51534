#pragma once

#include <cstdint>

#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// A scene in one frame, as a host pass sees it.
struct FrameScene {
  const Scene* scene = nullptr;  ///< geometry that never moves, materials, images, sun, environment
  const Pose* pose = nullptr;    ///< dynamic vertices, punctual lights, cameras
  Camera camera;                 ///< the one rendered through, where it is now
  uint32_t view_width = 1;       ///< of the graph's view [pixels]
  uint32_t view_height = 1;
  double time = 0;     ///< [s]
  uint32_t frame = 0;  ///< absolute frame number
  uint32_t seed = 0;   ///< of the run
};

}  // namespace lightloom::scene
