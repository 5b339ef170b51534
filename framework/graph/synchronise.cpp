#include "framework/graph/synchronise.hpp"

#include <algorithm>
#include <compare>
#include <optional>
#include <unordered_set>
#include <utility>

#include "framework/base/text.hpp"

namespace lightloom {
namespace {

enum class Section : uint8_t { once, frame };

/// A point where barriers can stand: before the pass of a step (`observation` 0) or before its observation
/// `observation` - 1.
struct Position {
  Section section = Section::frame;
  uint32_t step = 0;
  uint32_t observation = 0;
  auto operator<=>(const Position&) const = default;
};

struct Reader {
  Position position;
  Access access = Access::none;
  uint32_t first_age = 0;
  uint32_t last_age = 0;
  std::string name;
};

/// All that touches one value in a frame, or once.
struct Round {
  std::optional<Position> write;
  Access write_access = Access::none;
  std::string writer;
  std::vector<Reader> readers;  ///< in order of position
};

bool covers(Access wide, Access narrow) {
  const AccessInfo& a = access_info(wide);
  const AccessInfo& b = access_info(narrow);
  return (a.stages & b.stages) == b.stages && (a.access & b.access) == b.access;
}

bool same_stages(Access a, Access b) {
  return access_info(a).stages == access_info(b).stages;
}

Reader reader(const Observation& observation, const Position& position) {
  return {position, access_of(observation.observer), observation.age, observation.age,
          std::string(to_string(observation.observer))};
}

void collect(std::vector<Round>& rounds, const Graph& graph, const std::vector<PlanStep>& steps, Section section) {
  for (uint32_t step = 0; step < steps.size(); ++step) {
    const GraphPass& pass = graph.passes[steps[step].pass];
    for (const Use& use : pass.inputs)
      rounds[use.value].readers.push_back({{section, step, 0}, use.access, use.first_age, use.last_age, pass.name});
    for (const auto* uses : {&pass.outputs, &pass.scratch}) {
      for (const Use& use : *uses) {
        rounds[use.value].write = Position{section, step, 0};
        rounds[use.value].write_access = use.access;
        rounds[use.value].writer = pass.name;
      }
    }
    const std::vector<Observation>& observations = steps[step].observations;
    for (uint32_t i = 0; i < observations.size(); ++i)
      rounds[observations[i].value].readers.push_back(reader(observations[i], {section, step, i + 1}));
  }
}

std::vector<Round> collect_rounds(const Plan& plan) {
  std::vector<Round> rounds(plan.graph.values.size());
  collect(rounds, plan.graph, plan.once, Section::once);
  collect(rounds, plan.graph, plan.steps, Section::frame);
  for (const Observation& observation : plan.opening_observations)
    rounds[observation.value].readers.push_back(reader(observation, {Section::frame, 0, 0}));
  return rounds;
}

/// The accesses of readers that pass `filter`, in order, without those that an earlier one covers.
template <class Filter>
std::vector<Access> distinct_accesses(const Round& round, Filter filter) {
  std::vector<Access> accesses;
  for (const Reader& reader : round.readers) {
    if (!filter(reader)) continue;
    const bool known =
        std::any_of(accesses.begin(), accesses.end(), [&](Access access) { return covers(access, reader.access); });
    if (!known) accesses.push_back(reader.access);
  }
  return accesses;
}

/// Names in the order in which they came, each once.
class Names {
 public:
  void add(const std::string& name) {
    if (known_.insert(name).second) list_.push_back(name);
  }
  [[nodiscard]] std::string text() const { return join(list_, ", "); }

 private:
  std::vector<std::string> list_;
  std::unordered_set<std::string> known_;
};

template <class Filter>
std::string names_of(const Round& round, Access access, Filter filter) {
  Names names;
  for (const Reader& reader : round.readers) {
    if (!filter(reader) || !covers(access, reader.access)) continue;
    std::string name = reader.name;
    if (reader.first_age > 0)
      name += " (" + std::to_string(reader.last_age) + (reader.last_age == 1 ? " frame" : " frames") + " back)";
    names.add(name);
  }
  return names.text();
}

class Synchroniser {
 public:
  explicit Synchroniser(Plan& plan) : plan_(plan), rounds_(collect_rounds(plan)) {}

  void run() {
    frame_inputs();
    for (ValueId value = 0; value < rounds_.size(); ++value) {
      const Round& round = rounds_[value];
      initialise(value, round);
      if (round.write && round.write->section == Section::once) written_once(value, round);
      if (round.write && round.write->section == Section::frame) one_round(value, round);
    }
  }

 private:
  void frame_inputs() {
    plan_.frame_start.push_back({kFrameInputs, Access::frame_input_read, Access::transfer_write,
                                 Hazard::write_after_read, true, "the last frame's passes read the frame inputs"});
    plan_.inputs_ready.push_back({kFrameInputs, Access::transfer_write, Access::frame_input_read,
                                  Hazard::read_after_write, false, "passes read the frame inputs"});
  }

  /// Constants, rings and persistent values are cleared before the first frame. Who reads a ring before the frame's own
  /// read barriers waits for the clear here; all others, the writer too, are reached from here through the barriers of
  /// the first frame.
  void initialise(ValueId id, const Round& round) {
    const Value& value = plan_.graph.values[id];
    if (!value.constant && value.history == 0 && !value.persistent) return;
    const auto meets_clear = [&](const Reader& reader) {
      return value.constant || reader.position < read_barrier_reader(round)->position;
    };
    const std::vector<Access> accesses = distinct_accesses(round, meets_clear);
    for (const Access access : accesses)
      plan_.prologue_barriers.push_back({id, Access::transfer_write, access, Hazard::read_after_write, false,
                                         "cleared, read by " + names_of(round, access, meets_clear)});
    if (round.write && accesses.empty())
      plan_.prologue_barriers.push_back({id, Access::transfer_write, round.write_access, Hazard::write_after_write,
                                         false, "cleared, written by " + round.writer});
  }

  /// Before whom the barriers from write to readers stand: the first that can meet this frame's layer; where all look
  /// back, the first of all, which meets the last frame's.
  static std::vector<Reader>::const_iterator read_barrier_reader(const Round& round) {
    const auto first = std::find_if(round.readers.begin(), round.readers.end(),
                                    [](const Reader& reader) { return reader.first_age == 0; });
    return first == round.readers.end() ? round.readers.begin() : first;
  }

  /// One barrier for all who ever read it, where the first of them does.
  void written_once(ValueId id, const Round& round) {
    const auto anyone = [](const Reader& /*reader*/) { return true; };
    const auto early = std::find_if(round.readers.begin(), round.readers.end(),
                                    [](const Reader& reader) { return reader.position.section == Section::once; });
    std::vector<Barrier>& list = early == round.readers.end() ? plan_.once_barriers : at(early->position);
    for (const Access access : distinct_accesses(round, anyone))
      list.push_back({id, round.write_access, access, Hazard::read_after_write, false,
                      round.writer + " writes it once, read by " + names_of(round, access, anyone)});
  }

  void one_round(ValueId id, const Round& round) {
    if (round.readers.empty()) {
      at(*round.write)
          .push_back({id, round.write_access, round.write_access, Hazard::write_after_write, true,
                      round.writer + " wrote it in the last frame"});
      return;
    }
    const auto first = read_barrier_reader(round);
    const bool history_only = first->first_age > 0;
    const auto anyone = [](const Reader& /*reader*/) { return true; };
    const std::vector<Access> accesses = distinct_accesses(round, anyone);
    for (const Access access : accesses)
      at(first->position)
          .push_back({id, round.write_access, access, Hazard::read_after_write, history_only,
                      round.writer + " writes it, read by " + names_of(round, access, anyone)});
    before_next_write(id, round, accesses);
  }

  /// From the stages of every reader. The chain from the last write over its readers orders both writes as well.
  void before_next_write(ValueId id, const Round& round, const std::vector<Access>& accesses) {
    std::vector<Access> waited_for;
    for (const Access access : accesses) {
      const bool known =
          std::any_of(waited_for.begin(), waited_for.end(), [&](Access other) { return same_stages(other, access); });
      if (known) continue;
      waited_for.push_back(access);
      at(*round.write)
          .push_back({id, access, round.write_access, Hazard::write_after_read, true,
                      "read in earlier frames by " + names_of_stages(round, access)});
    }
  }

  static std::string names_of_stages(const Round& round, Access access) {
    Names names;
    for (const Reader& reader : round.readers)
      if (same_stages(reader.access, access)) names.add(reader.name);
    return names.text();
  }

  std::vector<Barrier>& at(const Position& position) {
    PlanStep& step = (position.section == Section::once ? plan_.once : plan_.steps)[position.step];
    return position.observation == 0 ? step.barriers : step.observations[position.observation - 1].barriers;
  }

  Plan& plan_;
  std::vector<Round> rounds_;
};

}  // namespace

void synchronise(Plan& plan) {
  Synchroniser(plan).run();
}

}  // namespace lightloom
