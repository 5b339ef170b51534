#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "framework/graph/host_context.hpp"
#include "framework/graph/param.hpp"
#include "framework/graph/pass_context.hpp"
#include "framework/graph/port.hpp"

namespace lightloom {

/// Parts of the frame state that a pass type reads besides its ports; a bit set.
enum class FrameState : uint32_t {
  none = 0,
  camera = 1,
  time = 2,
  seed = 4,
  static_geometry = 8,
  dynamic_geometry = 16,
  materials = 32,
  lights = 64,
};
constexpr FrameState operator|(FrameState a, FrameState b) {
  return static_cast<FrameState>(static_cast<uint32_t>(a) | static_cast<uint32_t>(b));
}
constexpr FrameState operator&(FrameState a, FrameState b) {
  return static_cast<FrameState>(static_cast<uint32_t>(a) & static_cast<uint32_t>(b));
}
/// Those parts that may differ between two frames of a scene; the others are what it was loaded with.
constexpr FrameState kChangingState =
    FrameState::camera | FrameState::time | FrameState::seed | FrameState::dynamic_geometry | FrameState::lights;
constexpr bool contains(FrameState set, FrameState part) {
  return (static_cast<uint32_t>(set) & static_cast<uint32_t>(part)) == static_cast<uint32_t>(part);
}

/// What a pass type needs of a device beyond Vulkan 1.3.
struct DeviceNeeds {
  bool ray_query =
      false;  ///< VK_KHR_ray_query and acceleration structures; the context binds the scene's as `scene_tlas`
};

/// A pass type: its ports, its params and `record` (or `host`). It keeps no state.
struct PassType {
  std::string name;
  uint32_t version = 1;
  std::string doc;  ///< first sentence is the summary; names the source of its formulas
  std::vector<Port> ports;
  std::vector<Param> params;
  FrameState reads = FrameState::none;  ///< the most that any params make it read
  /// What it reads with these params, a subset of `reads`; empty: `reads`, whatever the params.
  std::function<FrameState(const ParamSet&)> reads_with;
  bool side_effect = false;  ///< a root: never culled
  std::function<void(PassContext&)> record;
  /// A pass that computes on the host instead of recording commands; exactly one of `record` and `host` is set. Its
  /// inputs have access transfer_read, its outputs transfer_write.
  std::function<void(HostContext&)> host;
  DeviceNeeds needs;

  [[nodiscard]] const Port* find_port(std::string_view port, Direction direction) const;
  [[nodiscard]] const Param* find_param(std::string_view param) const;
  [[nodiscard]] FrameState reads_of(const ParamSet& chosen) const { return reads_with ? reads_with(chosen) : reads; }
};

class PassRegistry {
 public:
  /// Throws Error (run_failed) when the name is taken or the table contradicts itself (duplicate port, a bypass or
  /// `like` that names no input, a default out of range, …).
  void add(PassType type);
  [[nodiscard]] const PassType* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const;  ///< sorted

 private:
  std::map<std::string, PassType, std::less<>> types_;
};

}  // namespace lightloom
