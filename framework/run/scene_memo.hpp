#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <typeindex>

namespace lightloom::run {

/// What host passes have derived from a loaded scene alone (HostContext::derived), by type. Executors on one scene may
/// share it, in several threads: who asks for what another is making waits for it.
class SceneMemo {
 public:
  using Made = std::shared_ptr<const void>;

  /// The kept thing of that type, made by `make` at the first call; stays where it is. If `make` throws, nothing is
  /// kept, and the next call tries again.
  const Made& get(std::type_index type, const std::function<Made()>& make);

 private:
  struct Slot {
    std::mutex making;
    Made made;
  };
  std::mutex finding_;
  std::map<std::type_index, Slot> slots_;
};

}  // namespace lightloom::run
