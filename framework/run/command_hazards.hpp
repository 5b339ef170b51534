#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "framework/gpu/reflection.hpp"
#include "framework/graph/graph.hpp"
#include "framework/run/barriers.hpp"

namespace lightloom::run {

/// What one command of a pass does to one of the pass's images. `slot` counts the pass's inputs, outputs and scratch in
/// this order.
struct Touch {
  uint32_t slot = 0;
  Access access = Access::none;
  bool operator==(const Touch&) const = default;
};

/// What a pipeline's shaders do to the images that the pass binds. Attachments are not among them.
[[nodiscard]] std::vector<Touch> bound_touches(const GraphPass& pass, const gpu::Reflection& reflection);
/// `access` to all parts of an output or scratch port; empty if there is no such port.
[[nodiscard]] std::vector<Touch> port_touches(const GraphPass& pass, std::string_view port, Access access);
/// `access` to the pass's output or scratch `use`.
[[nodiscard]] Touch written_touch(const GraphPass& pass, const Use& use, Access access);

/// Finds what must stand between the commands of one pass, and no more. The plan's barriers before the pass end at the
/// accesses that its ports declare, and those after it begin there; a command may touch an image otherwise (a clear, a
/// draw that stores into an image), so the first such one is chained to the declared access and the last one back to
/// it. Images are tracked whole; an input is never what the pass writes (a history has other layers).
class CommandHazards {
 public:
  explicit CommandHazards(const GraphPass& pass);

  /// What to record before a command that does this, recorded after those given before.
  [[nodiscard]] std::vector<Dependency> before(std::span<const Touch> touches);
  /// What to record after the last command.
  [[nodiscard]] std::vector<Dependency> finish();

 private:
  /// An access that a later one may have to wait for.
  struct Past {
    Access access = Access::none;
    bool writes = false;
    bool declared = false;        ///< stands for all before the pass
    std::vector<Access> reached;  ///< what waits for it already
  };
  struct Slot {
    Access declared = Access::none;
    std::vector<Past> past;  ///< the last write and the reads since
  };
  static bool waits(const Past& past, Access access);
  /// What `touches` would have to wait for and does not yet, among earlier writes or reads.
  [[nodiscard]] std::vector<Dependency> missing(std::span<const Touch> touches, bool on_writes) const;
  void carry(const std::vector<Dependency>& dependencies);
  void remember(const Touch& touch);

  std::vector<Slot> slots_;
};

}  // namespace lightloom::run
