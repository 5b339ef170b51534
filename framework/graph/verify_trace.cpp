#include "framework/graph/verify_trace.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace lightloom::verification {
namespace {

/// Which pieces each value lies in. Heaps are cut where a value begins or ends.
class MemoryMap {
 public:
  MemoryMap(const Graph& graph, const PlannedMemory& memory) : graph_(graph), memory_(memory) {
    if (memory.sharing == nullptr) return;
    cuts_.resize(memory.sharing->heaps.size());
    for (ValueId value = 0; value < graph.values.size(); ++value) {
      if (!memory.sharing->places[value]) continue;
      const SharedPlace& place = *memory.sharing->places[value];
      cuts_[place.heap].insert(place.offset);
      cuts_[place.heap].insert(place.offset + memory.needs[value].size);
    }
  }

  [[nodiscard]] std::vector<Piece> pieces(ValueId value, int layer) const {
    if (value == kFrameInputs || memory_.sharing == nullptr || !memory_.sharing->places[value])
      return {{false, value, static_cast<uint64_t>(layer)}};
    const SharedPlace& place = *memory_.sharing->places[value];
    std::vector<Piece> result;
    const auto end = cuts_[place.heap].lower_bound(place.offset + memory_.needs[value].size);
    for (auto cut = cuts_[place.heap].lower_bound(place.offset); cut != end; ++cut)
      result.push_back({true, place.heap, *cut});
    return result;
  }

  [[nodiscard]] int layers(ValueId value) const {
    return value == kFrameInputs ? 1 : static_cast<int>(ring_layers(graph_.values[value]));
  }

 private:
  const Graph& graph_;
  const PlannedMemory& memory_;
  std::vector<std::set<uint64_t>> cuts_;
};

/// Plays a plan frame by frame into traces.
class Player {
 public:
  Player(const Plan& plan, const MemoryMap& map) : plan_(plan), map_(map), written_once_(plan.graph.values.size()) {
    for (const PlanStep& step : plan.once)
      for (const auto* uses : {&plan.graph.passes[step.pass].outputs, &plan.graph.passes[step.pass].scratch})
        for (const Use& use : *uses) written_once_[use.value] = true;
  }

  std::map<Piece, Trace> run(Verification& counts) {
    uint32_t longest = 1;
    for (const Value& value : plan_.graph.values) longest = std::max(longest, ring_layers(value));
    const int frames = static_cast<int>(longest) + 2;
    for (const Clear& clear : plan_.prologue)
      for (int layer = 0; layer < map_.layers(clear.value); ++layer)
        touch({.value = clear.value, .access = Access::transfer_write, .who = "the clear"}, layer);
    barriers(plan_.prologue_barriers);
    for (int frame = 0; frame < frames; ++frame) play(frame);
    counts.frames = static_cast<uint64_t>(frames);
    counts.accesses = accesses_;
    counts.barriers = barriers_;
    return std::move(traces_);
  }

 private:
  void play(int frame) {
    barriers(plan_.frame_start);
    touch({.value = kFrameInputs,
           .access = Access::transfer_write,
           .frame = frame,
           .content = kUndefined,
           .who = "the upload"},
          0);
    barriers(plan_.inputs_ready);
    if (frame == 0) {
      steps(plan_.once, frame);
      barriers(plan_.once_barriers);
    }
    observations(plan_.opening_observations, frame);
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
      for (const auto* uses : {&pass.outputs, &pass.scratch})
        for (const Use& use : *uses)
          touch({.value = use.value,
                 .access = use.access,
                 .frame = frame,
                 .content = kept(use.value, frame),
                 .who = pass.name},
                frame % map_.layers(use.value));
      observations(step.observations, frame);
    }
  }

  /// What a pass expects of its own output: a persistent one holds its last frame's work.
  int kept(ValueId value, int frame) const {
    return plan_.graph.values[value].persistent ? std::max(frame - 1, kPrologue) : kUndefined;
  }

  void observations(const std::vector<Observation>& list, int frame) {
    for (const Observation& observation : list) {
      barriers(observation.barriers);
      read(observation.value, access_of(observation.observer), observation.age, frame, to_string(observation.observer));
    }
  }

  void read(ValueId value, Access access, uint32_t age, int frame, std::string_view who) {
    const bool constant = value != kFrameInputs && plan_.graph.values[value].constant.has_value();
    const bool once = value != kFrameInputs && written_once_[value];
    const int written = constant ? kPrologue : once ? 0 : frame - static_cast<int>(age);
    const int layers = map_.layers(value);
    touch({.value = value, .access = access, .frame = frame, .content = std::max(written, kPrologue), .who = who},
          constant ? 0 : ((written % layers) + layers) % layers);
  }

  void touch(const Event& event, int layer) {
    ++accesses_;
    for (const Piece& piece : map_.pieces(event.value, layer)) trace_of(piece).push_back(event);
  }

  /// Full barriers enter a trace when something else follows: of those in a row the first, behind which all is done,
  /// and the last, which may be recorded together with what follows.
  Trace& trace_of(const Piece& piece) {
    Trace& trace = traces_[piece];
    std::size_t& seen = full_barriers_seen_[piece];
    if (seen < full_barriers_.size() && !trace.empty()) {
      trace.push_back(full_barriers_[seen]);
      if (seen + 1 < full_barriers_.size()) trace.push_back(full_barriers_.back());
    }
    seen = full_barriers_.size();
    return trace;
  }

  void barriers(const std::vector<Barrier>& list) {
    ++batch_;
    for (const Barrier& barrier : list) {
      ++barriers_;
      const Event event{.kind = barrier.takes_over ? Event::Kind::takeover : Event::Kind::barrier,
                        .value = barrier.value,
                        .from = barrier.from,
                        .access = barrier.to,
                        .batch = batch_,
                        .who = {}};
      if (barrier.value == kEverything) {
        full_barriers_.push_back(event);
        continue;
      }
      for (int layer = 0; layer < map_.layers(barrier.value); ++layer) {
        for (const Piece& piece : map_.pieces(barrier.value, layer)) trace_of(piece).push_back(event);
      }
    }
  }

  const Plan& plan_;
  const MemoryMap& map_;
  std::vector<bool> written_once_;
  std::map<Piece, Trace> traces_;
  std::vector<Event> full_barriers_;
  std::map<Piece, std::size_t> full_barriers_seen_;
  uint32_t batch_ = 0;
  uint64_t accesses_ = 0;
  uint64_t barriers_ = 0;
};

}  // namespace

std::map<Piece, Trace> play(const Plan& plan, const PlannedMemory& memory, Verification& counts) {
  const MemoryMap map(plan.graph, memory);
  return Player(plan, map).run(counts);
}

}  // namespace lightloom::verification
