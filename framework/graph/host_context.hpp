#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <typeindex>

#include "framework/graph/desc.hpp"
#include "framework/graph/param.hpp"

namespace lightloom::scene {
struct FrameScene;
}

namespace lightloom {

/// An image that a host pass reads: texels tightly packed, x fastest, then y, then z, channels innermost.
struct HostInput {
  Format format = Format::rgba32_sfloat;
  Extent3 extent;
  std::span<const std::byte> texels;
};

/// An image that a host pass writes, laid out alike; it starts as zeros.
struct HostOutput {
  Format format = Format::rgba32_sfloat;
  Extent3 extent;
  std::span<std::byte> texels;
};

/// All that a host pass (PassType::host) can see. The executor brings its inputs to the host before, and what it wrote
/// back to the device after.
class HostContext {
 public:
  virtual ~HostContext() = default;

  [[nodiscard]] virtual const ParamSet& params() const = 0;
  [[nodiscard]] virtual bool connected(std::string_view input_port) const = 0;
  /// Does anything read an output? What nobody wants need not be written.
  [[nodiscard]] virtual bool wanted(std::string_view output_port) const = 0;
  /// One part of a connected input (`part` empty for a single image). Throws Error for what the type does not declare.
  [[nodiscard]] virtual HostInput input(std::string_view port, std::string_view part) const = 0;
  [[nodiscard]] virtual HostOutput output(std::string_view port, std::string_view part) = 0;
  /// The scene as it is in this frame: geometry, materials, lights, camera, frame number and seed.
  [[nodiscard]] virtual const scene::FrameScene& scene() const = 0;

  /// Something that follows from the loaded scene alone, whatever the frame, params and ports (an acceleration
  /// structure of what never moves, decoded textures): made by the first who asks, and kept for as long as the scene.
  template <class T>
  const T& derived(const std::function<T()>& make) {
    const std::shared_ptr<const void>& slot =
        derived_slot(typeid(T), [&]() -> std::shared_ptr<const void> { return std::make_shared<const T>(make()); });
    return *static_cast<const T*>(slot.get());
  }

 protected:
  virtual const std::shared_ptr<const void>& derived_slot(std::type_index type,
                                                          const std::function<std::shared_ptr<const void>()>& make) = 0;
};

}  // namespace lightloom
