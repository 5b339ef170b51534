#include "tests/graph/hazard_checker.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace lightloom {
namespace {

struct Event {
  bool is_barrier = false;
  Access from = Access::none;  ///< of a barrier
  Access access = Access::none;
  int layer = 0;     ///< accesses only
  int frame = -1;    ///< -1: the prologue
  int content = -2;  ///< reads: frame whose write is expected (-1: the clear)
  std::string who;
};

/// What a barrier makes visible, and to whom.
struct Scope {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
};

bool within(uint64_t part, uint64_t whole) {
  return (part & ~whole) == 0;
}

class Player {
 public:
  Player(const Plan& plan, std::size_t limit) : plan_(plan), limit_(limit) {}

  std::vector<std::string> run() {
    uint32_t longest = 1;
    for (const Value& value : plan_.graph.values) longest = std::max(longest, ring_layers(value));
    for (const Clear& clear : plan_.prologue) {
      const auto layers = static_cast<int>(ring_layers(plan_.graph.values[clear.value]));
      for (int layer = 0; layer < layers; ++layer) touch(clear.value, Access::transfer_write, layer, -1, "clear");
    }
    barriers(plan_.prologue_barriers);
    for (int frame = 0; frame < static_cast<int>(longest) + 2; ++frame) play(frame);
    for (const auto& [value, events] : traces_) check(value, events);
    return std::move(problems_);
  }

 private:
  void play(int frame) {
    barriers(plan_.frame_start);
    touch(kFrameInputs, Access::transfer_write, 0, frame, "upload");
    barriers(plan_.inputs_ready);
    if (frame == 0) {
      steps(plan_.once, frame);
      barriers(plan_.once_barriers);
    }
    copies(plan_.opening_copies, frame);
    steps(plan_.steps, frame);
  }

  void steps(const std::vector<PlanStep>& list, int frame) {
    for (const PlanStep& step : list) {
      barriers(step.barriers);
      const GraphPass& pass = plan_.graph.passes[step.pass];
      read(kFrameInputs, Access::frame_input_read, 0, frame, pass.name);
      for (const Use& use : pass.inputs)
        for (uint32_t age = use.first_age; age <= use.last_age; ++age)
          read(use.value, use.access, age, frame, pass.name);
      for (const Use& use : pass.outputs) write(use, frame, pass.name);
      for (const Use& use : pass.scratch) write(use, frame, pass.name);
      copies(step.copies, frame);
    }
  }

  void copies(const std::vector<Copy>& list, int frame) {
    for (const Copy& copy : list) {
      barriers(copy.barriers);
      read(copy.value, Access::transfer_read, copy.age, frame, "copy");
    }
  }

  void barriers(const std::vector<Barrier>& list) {
    for (const Barrier& barrier : list) {
      Event event;
      event.is_barrier = true;
      event.from = barrier.from;
      event.access = barrier.to;
      traces_[barrier.value].push_back(event);
    }
  }

  int ring(ValueId value) const {
    return value == kFrameInputs ? 1 : static_cast<int>(ring_layers(plan_.graph.values[value]));
  }

  /// The step of `list` whose pass writes the value.
  const GraphPass* writer(const std::vector<PlanStep>& list, ValueId value) const {
    const auto writes = [value](const Use& use) { return use.value == value; };
    for (const PlanStep& step : list) {
      const GraphPass& pass = plan_.graph.passes[step.pass];
      for (const auto* uses : {&pass.outputs, &pass.scratch})
        if (std::any_of(uses->begin(), uses->end(), writes)) return &pass;
    }
    return nullptr;
  }

  bool once(ValueId value) const { return writer(plan_.once, value) != nullptr; }

  /// Does its pass find its own work of the frame before in it?
  bool keeps(ValueId value) const {
    const GraphPass* pass = value == kFrameInputs || ring(value) > 1 ? nullptr : writer(plan_.steps, value);
    return pass != nullptr && std::any_of(pass->type->ports.begin(), pass->type->ports.end(), [&](const Port& port) {
             return port.direction != Direction::in && port.name == plan_.graph.values[value].port && port.persistent;
           });
  }

  Event& touch(ValueId value, Access access, int layer, int frame, const std::string& who) {
    Event event;
    event.access = access;
    event.layer = layer;
    event.frame = frame;
    event.who = who;
    return traces_[value].emplace_back(event);
  }

  void write(const Use& use, int frame, const std::string& who) {
    touch(use.value, use.access, frame % ring(use.value), frame, who);
  }

  void read(ValueId value, Access access, uint32_t age, int frame, const std::string& who) {
    const int layers = ring(value);
    const bool constant = value != kFrameInputs && plan_.graph.values[value].constant.has_value();
    const int written = constant ? -1 : once(value) ? 0 : frame - static_cast<int>(age);
    Event& event = touch(value, access, constant ? 0 : ((written % layers) + layers) % layers, frame, who);
    event.content = std::max(written, -1);
  }

  void complain(ValueId value, const std::string& sentence) {
    if (problems_.size() >= limit_) return;
    problems_.push_back((value == kFrameInputs ? "frame inputs" : value_name(plan_.graph.values[value])) + ": " +
                        sentence);
  }

  void check(ValueId value, const std::vector<Event>& events) {
    const auto first = std::find_if(events.begin(), events.end(), [](const Event& event) { return !event.is_barrier; });
    if (first != events.end() && first->frame >= 0 && keeps(value))
      complain(value, first->who + " rewrites a part of what nobody wrote");
    for (std::size_t i = 0; i < events.size() && problems_.size() < limit_; ++i) {
      if (events[i].is_barrier) continue;
      if (!access_info(events[i].access).writes) check_content(value, events, i);
      check_later(value, events, i);
    }
  }

  void check_content(ValueId value, const std::vector<Event>& events, std::size_t read) {
    for (std::size_t i = read; i-- > 0;) {
      if (events[i].is_barrier || events[i].layer != events[read].layer || !access_info(events[i].access).writes)
        continue;
      if (events[i].frame != events[read].content)
        complain(value, events[read].who + " reads frame " + std::to_string(events[i].frame) + " instead of " +
                            std::to_string(events[read].content));
      return;
    }
    complain(value, events[read].who + " reads what nobody wrote");
  }

  /// Follows what event `first` reaches through barriers, and holds every later conflicting access against it.
  void check_later(ValueId value, const std::vector<Event>& events, std::size_t first) {
    const AccessInfo& source = access_info(events[first].access);
    VkPipelineStageFlags2 reached = 0;
    bool available = false;
    std::vector<Scope> visible;
    for (std::size_t i = first + 1; i < events.size(); ++i) {
      const Event& event = events[i];
      const AccessInfo& target = access_info(event.access);
      if (event.is_barrier) {
        const AccessInfo& from = access_info(event.from);
        const bool direct = within(source.stages, from.stages);
        if (!direct && (reached & from.stages) == 0) continue;
        reached |= target.stages;
        available = available || (direct && within(source.access & kWrites, from.access));
        if (available) visible.push_back({target.stages, target.access});
        continue;
      }
      // A pass's uses of one value at several layers, and its own read-modify-write, are one moment.
      if (event.layer != events[first].layer || (!source.writes && !target.writes)) continue;
      if (!ordered(source, target, reached, available, visible))
        complain(value, events[first].who + " in frame " + std::to_string(events[first].frame) + " and " + event.who +
                            " in frame " + std::to_string(event.frame) + " collide");
    }
  }

  static bool ordered(const AccessInfo& source, const AccessInfo& target, VkPipelineStageFlags2 reached, bool available,
                      const std::vector<Scope>& visible) {
    if (!within(target.stages, reached)) return false;
    if (!source.writes) return true;
    return available && std::any_of(visible.begin(), visible.end(), [&](const Scope& scope) {
             return within(target.stages, scope.stages) && within(target.access, scope.access);
           });
  }

  static constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                                            VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                            VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  const Plan& plan_;
  std::size_t limit_;
  std::map<ValueId, std::vector<Event>> traces_;
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> find_hazards(const Plan& plan, std::size_t limit) {
  return Player(plan, limit).run();
}

}  // namespace lightloom
