#pragma once

#include <vector>

#include "framework/gpu/image.hpp"
#include "framework/gpu/reflection.hpp"

namespace lightloom::run {

/// Stands in for an optional input that is not connected, by the shape and numeric class that the shader declares.
class Placeholders {
 public:
  explicit Placeholders(gpu::Device& device);
  [[nodiscard]] gpu::ImageView view(const gpu::Binding& binding) const;

 private:
  std::vector<gpu::Image> images_;  ///< 2D and 3D, floating and unsigned
};

}  // namespace lightloom::run
