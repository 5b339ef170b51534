#include "framework/graph/share_memory.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/graph/place.hpp"

namespace lightloom {
namespace {

/// A value that lives within a frame.
struct Tenant {
  ValueId value = 0;
  Block block;
  Access written = Access::none;
  std::vector<Access> last_uses;  ///< distinct; of its readers, or its write where nobody reads it
  uint64_t offset = 0;            ///< in its heap [bytes]
};

/// Who had which bytes of a heap last.
class Occupants {
 public:
  /// The tenant takes its bytes; returns who had them, some more than once.
  std::vector<uint32_t> replace(uint64_t begin, uint64_t end, uint32_t tenant) {
    cut(begin);
    cut(end);
    std::vector<uint32_t> before;
    const auto first = parts_.find(begin);
    const auto last = parts_.find(end);
    for (auto part = first; part != last; ++part)
      if (part->second) before.push_back(*part->second);
    parts_.erase(std::next(first), last);
    first->second = tenant;
    return before;
  }

 private:
  void cut(uint64_t at) {
    const auto behind = parts_.upper_bound(at);
    parts_.emplace_hint(behind, at, std::prev(behind)->second);
  }

  /// By first byte, each up to the next; empty where nobody was.
  std::map<uint64_t, std::optional<uint32_t>> parts_ = {{0, std::nullopt}};
};

class Sharing {
 public:
  Sharing(Plan& plan, std::span<const MemoryNeed> needs) : plan_(plan), graph_(plan.graph), needs_(needs) {}

  MemorySharing run() {
    result_.places.resize(graph_.values.size());
    for (auto& [kinds, tenants] : tenants_by_kind()) settle(kinds, tenants);
    return std::move(result_);
  }

 private:
  std::vector<bool> has_own_memory() const {
    std::vector<bool> own(graph_.values.size(), true);
    for (const PlanStep& step : plan_.steps) {
      const GraphPass& pass = graph_.passes[step.pass];
      for (const auto* uses : {&pass.outputs, &pass.scratch}) {
        for (const Use& use : *uses) {
          const Value& value = graph_.values[use.value];
          own[use.value] = value.history > 0 || value.persistent || value.constant.has_value();
        }
      }
    }
    for (const GraphOutput& output : graph_.outputs) own[output.value] = true;
    return own;
  }

  std::map<uint32_t, std::vector<Tenant>> tenants_by_kind() const {
    const std::vector<bool> own = has_own_memory();
    std::vector<std::optional<Tenant>> found(graph_.values.size());
    for (uint32_t step = 0; step < plan_.steps.size(); ++step) {
      const GraphPass& pass = graph_.passes[plan_.steps[step].pass];
      for (const auto* uses : {&pass.outputs, &pass.scratch})
        for (const Use& use : *uses)
          if (!own[use.value]) found[use.value] = begin(use, step);
      for (const Use& use : pass.inputs)
        if (found[use.value]) touch(*found[use.value], use.access, step);
      for (const Observation& observation : plan_.steps[step].observations)
        if (found[observation.value]) touch(*found[observation.value], access_of(observation.observer), step);
    }
    std::map<uint32_t, std::vector<Tenant>> by_kind;
    for (const std::optional<Tenant>& tenant : found)
      if (tenant) by_kind[needs_[tenant->value].kinds].push_back(*tenant);
    return by_kind;
  }

  Tenant begin(const Use& use, uint32_t step) const {
    const MemoryNeed& need = needs_[use.value];
    return {use.value, {need.size, need.alignment, step, step}, use.access, {}, 0};
  }

  static void touch(Tenant& tenant, Access access, uint32_t step) {
    tenant.block.last = step;
    if (std::find(tenant.last_uses.begin(), tenant.last_uses.end(), access) == tenant.last_uses.end())
      tenant.last_uses.push_back(access);
  }

  void settle(uint32_t kinds, std::vector<Tenant>& tenants) {
    std::vector<Block> blocks;
    for (const Tenant& tenant : tenants) blocks.push_back(tenant.block);
    const Placement placement = place(blocks);
    SharedHeap heap{kinds, placement.heap, placement.lower_bound, 0};
    for (size_t i = 0; i < tenants.size(); ++i) {
      Tenant& tenant = tenants[i];
      if (tenant.last_uses.empty()) tenant.last_uses = {tenant.written};
      tenant.offset = placement.offsets[i];
      heap.unshared += tenant.block.size;
      result_.places[tenant.value] = SharedPlace{static_cast<uint32_t>(result_.heaps.size()), placement.offsets[i]};
    }
    result_.heaps.push_back(heap);
    std::stable_sort(tenants.begin(), tenants.end(),
                     [](const Tenant& a, const Tenant& b) { return a.block.first < b.block.first; });
    take_over(tenants);
  }

  /// Each takes its memory from those who had a byte of it last, in this frame or, as all frames are alike, in the one
  /// before.
  void take_over(const std::vector<Tenant>& tenants) {
    Occupants occupants;
    for (const bool frame_before : {true, false}) {
      for (uint32_t i = 0; i < tenants.size(); ++i) {
        const Tenant& tenant = tenants[i];
        if (tenant.block.size == 0) continue;
        const std::vector<uint32_t> before = occupants.replace(tenant.offset, tenant.offset + tenant.block.size, i);
        if (!frame_before) wait_for(tenants, i, before);
      }
    }
  }

  void wait_for(const std::vector<Tenant>& tenants, uint32_t index, std::vector<uint32_t> before) {
    const auto count = static_cast<uint32_t>(tenants.size());
    const auto steps_back = [&](uint32_t other) { return (index + count - 1 - other) % count; };
    std::sort(before.begin(), before.end(), [&](uint32_t a, uint32_t b) { return steps_back(a) < steps_back(b); });
    before.erase(std::unique(before.begin(), before.end()), before.end());
    // Alone there, its own last frame is behind barriers already.
    if (before == std::vector{index}) return;
    for (const uint32_t other : before) {
      const bool previous_frame = other >= index;
      for (const Access access : tenants[other].last_uses) add(tenants[index], tenants[other], access, previous_frame);
    }
  }

  void add(const Tenant& tenant, const Tenant& earlier, Access access, bool previous_frame) {
    Barrier barrier{tenant.value,   access,
                    tenant.written, access_info(access).writes ? Hazard::write_after_write : Hazard::write_after_read,
                    previous_frame, "takes over the memory of " + value_name(graph_.values[earlier.value])};
    barrier.takes_over = true;
    std::vector<Barrier>& list = plan_.steps[tenant.block.first].barriers;
    // One reason an access and a frame: the names join.
    for (Barrier& other : list) {
      if (!other.takes_over || other.value != barrier.value || other.from != access ||
          other.previous_frame != previous_frame)
        continue;
      other.reason += ", " + value_name(graph_.values[earlier.value]);
      return;
    }
    list.push_back(std::move(barrier));
  }

  Plan& plan_;
  const Graph& graph_;
  std::span<const MemoryNeed> needs_;
  MemorySharing result_;
};

}  // namespace

MemorySharing share_memory(Plan& plan, std::span<const MemoryNeed> needs) {
  return Sharing(plan, needs).run();
}

}  // namespace lightloom
