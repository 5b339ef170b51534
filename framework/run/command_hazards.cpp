#include "framework/run/command_hazards.hpp"

#include <algorithm>
#include <string_view>

namespace lightloom::run {
namespace {

bool within(uint64_t part, uint64_t whole) {
  return (part & ~whole) == 0;
}

constexpr VkAccessFlags2 kReadBits = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT |
                                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;

/// Does a barrier from `from` wait for all that `access` does, and make what it writes available?
bool ends(const AccessInfo& access, const AccessInfo& from) {
  return within(access.stages, from.stages) && (!access.writes || within(access.access & ~kReadBits, from.access));
}

Access compute_access(const gpu::Binding& binding) {
  if (binding.kind != gpu::BindingKind::storage_image) return Access::compute_sampled_read;
  if (!binding.writable) return Access::compute_storage_read;
  return binding.readable ? Access::compute_storage_read_write : Access::compute_storage_write;
}

Access bound_access(const gpu::Binding& binding) {
  const bool storage = binding.kind == gpu::BindingKind::storage_image;
  switch (binding.stages) {
    case VK_SHADER_STAGE_COMPUTE_BIT:
      return compute_access(binding);
    case VK_SHADER_STAGE_FRAGMENT_BIT:
      return storage ? Access::fragment_storage_read_write : Access::fragment_sampled_read;
    default:
      return storage && binding.writable ? Access::anything : Access::frame_input_read;
  }
}

void add(std::vector<Dependency>& dependencies, const Dependency& dependency) {
  if (std::find(dependencies.begin(), dependencies.end(), dependency) == dependencies.end())
    dependencies.push_back(dependency);
}

/// Calls `visit` with each use of the pass and its slot.
template <class Visit>
void for_each_slot(const GraphPass& pass, Visit visit) {
  uint32_t slot = 0;
  for (const std::vector<Use>* uses : {&pass.inputs, &pass.outputs, &pass.scratch})
    for (const Use& use : *uses) visit(slot++, use);
}

}  // namespace

std::vector<Touch> bound_touches(const GraphPass& pass, const gpu::Reflection& reflection) {
  std::vector<Touch> touches;
  for_each_slot(pass, [&](uint32_t slot, const Use& use) {
    for (const gpu::Binding& binding : reflection.bindings)
      if (binding.name == use.shader_name) touches.push_back({slot, bound_access(binding)});
  });
  return touches;
}

std::vector<Touch> port_touches(const GraphPass& pass, std::string_view port, Access access) {
  std::vector<Touch> touches;
  for_each_slot(pass, [&](uint32_t slot, const Use& use) {
    if (slot >= pass.inputs.size() && use.port == port) touches.push_back({slot, access});
  });
  return touches;
}

Touch written_touch(const GraphPass& pass, const Use& use, Access access) {
  Touch touch{.access = access};
  for_each_slot(pass, [&](uint32_t slot, const Use& each) {
    if (&each == &use) touch.slot = slot;
  });
  return touch;
}

CommandHazards::CommandHazards(const GraphPass& pass) {
  for_each_slot(pass, [&](uint32_t, const Use& use) {
    // What was written before the pass is there for the declared access, and for no other.
    slots_.push_back({use.access, {{.access = use.access, .writes = true, .declared = true, .reached = {use.access}}}});
  });
}

bool CommandHazards::waits(const Past& past, Access access) {
  const AccessInfo& target = access_info(access);
  return std::any_of(past.reached.begin(), past.reached.end(), [&](Access reached) {
    const AccessInfo& scope = access_info(reached);
    // Whose port is only written does not care what was there, though the shader might read it.
    const bool blind = past.declared && !access_info(past.access).reads;
    const VkAccessFlags2 needed = !past.writes ? 0 : blind ? target.access & ~kReadBits : target.access;
    return within(target.stages, scope.stages) && within(needed, scope.access);
  });
}

std::vector<Dependency> CommandHazards::before(std::span<const Touch> touches) {
  // Readers first: who waits for them may so have waited for the write before them.
  std::vector<Dependency> dependencies = missing(touches, false);
  carry(dependencies);
  const std::vector<Dependency> after_writes = missing(touches, true);
  carry(after_writes);
  dependencies.insert(dependencies.end(), after_writes.begin(), after_writes.end());
  for (const Touch& touch : touches)
    if (access_info(touch.access).writes) slots_[touch.slot].past.clear();
  for (const Touch& touch : touches) remember(touch);
  return dependencies;
}

std::vector<Dependency> CommandHazards::missing(std::span<const Touch> touches, bool on_writes) const {
  std::vector<Dependency> dependencies;
  for (const Touch& touch : touches) {
    for (const Past& past : slots_[touch.slot].past) {
      const bool conflict = past.writes || access_info(touch.access).writes;
      if (past.writes == on_writes && conflict && !waits(past, touch.access))
        add(dependencies, {past.access, touch.access});
    }
  }
  return dependencies;
}

/// A barrier is about all memory, so those of other images may be served by it as well.
void CommandHazards::carry(const std::vector<Dependency>& dependencies) {
  for (Slot& slot : slots_) {
    for (Past& past : slot.past) {
      const size_t known = past.reached.size();
      for (const Dependency& dependency : dependencies) {
        const AccessInfo& from = access_info(dependency.from);
        const bool chained =
            std::any_of(past.reached.begin(), past.reached.begin() + static_cast<std::ptrdiff_t>(known),
                        [&](Access reached) { return (access_info(reached).stages & from.stages) != 0; });
        if (chained || (!past.declared && ends(access_info(past.access), from))) past.reached.push_back(dependency.to);
      }
    }
  }
}

void CommandHazards::remember(const Touch& touch) {
  std::vector<Past>& past = slots_[touch.slot].past;
  // A read again: what waits for the earlier one does not wait for this one.
  std::erase_if(past, [&](const Past& each) { return !each.writes && each.access == touch.access; });
  past.push_back({touch.access, access_info(touch.access).writes, false, {}});
}

std::vector<Dependency> CommandHazards::finish() {
  std::vector<Dependency> dependencies;
  for (const Slot& slot : slots_) {
    const AccessInfo& declared = access_info(slot.declared);
    for (const Past& past : slot.past) {
      const bool chained = std::any_of(past.reached.begin(), past.reached.end(), [&](Access reached) {
        return (access_info(reached).stages & declared.stages) != 0;
      });
      if (!past.declared && !chained && !ends(access_info(past.access), declared))
        add(dependencies, {past.access, slot.declared});
    }
  }
  carry(dependencies);
  return dependencies;
}

}  // namespace lightloom::run
