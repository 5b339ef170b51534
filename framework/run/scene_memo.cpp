#include "framework/run/scene_memo.hpp"

namespace lightloom::run {

const SceneMemo::Made& SceneMemo::get(std::type_index type, const std::function<Made()>& make) {
  Slot* slot = nullptr;
  {
    const std::scoped_lock lock(finding_);
    slot = &slots_[type];
  }
  const std::scoped_lock lock(slot->making);
  if (!slot->made) slot->made = make();
  return slot->made;
}

}  // namespace lightloom::run
