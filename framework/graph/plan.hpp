#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "framework/graph/access.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/schedule.hpp"

namespace lightloom {

enum class Hazard : uint8_t { read_after_write, write_after_read, write_after_write };
[[nodiscard]] std::string_view to_string(Hazard hazard);

/// Stands for the scene and frame buffers, uploaded by transfer at the start of a frame.
constexpr ValueId kFrameInputs = std::numeric_limits<ValueId>::max();
/// Stands for all memory: of the barriers of SyncPolicy::conservative.
constexpr ValueId kEverything = kFrameInputs - 1;
/// What a barrier is about: the value's name, "frame inputs" or "everything".
[[nodiscard]] std::string barrier_subject(const Graph& graph, ValueId value);

/// A memory dependency between all earlier `from` accesses and all later `to` accesses to all layers of a value. No
/// layout changes: images live in GENERAL.
struct Barrier {
  ValueId value = 0;
  Access from = Access::none;
  Access to = Access::none;
  Hazard hazard = Hazard::read_after_write;
  bool previous_frame = false;  ///< what it waits for was recorded in an earlier frame
  std::string reason;
  /// The value takes memory from others (share_memory.hpp): `from` is a use of theirs, and what the image held before
  /// is undefined after it.
  bool takes_over = false;
};

/// Who looks at a value without changing it.
enum class Observer : uint8_t {
  read_back,  ///< copied for the host: outputs, dumps, probes
  scan,       ///< searched on the device for what no texel should hold: NaN, infinity, poison
};
[[nodiscard]] Access access_of(Observer observer);
[[nodiscard]] std::string_view to_string(Observer observer);  ///< "the read-back", "the scan"

/// Observation of a value as soon as it is there, so that nothing lives longer for it.
struct Observation {
  ValueId value = 0;
  uint32_t age = 0;
  Observer observer = Observer::read_back;
  std::vector<Barrier> barriers;  ///< to be recorded before it
};

struct PlanStep {
  uint32_t pass = 0;                      ///< index into Graph::passes
  std::vector<Barrier> barriers;          ///< to be recorded before the pass
  std::vector<Observation> observations;  ///< after the pass
};

/// Every layer of a value is cleared, once, before anything else.
struct Clear {
  ValueId value = 0;
  ClearColor color{0, 0, 0, 0};
};

/// What is executed, as plain data. Before the first frame: prologue, prologue_barriers. Then each frame in order:
/// frame_start, uploads of frame inputs, inputs_ready, in the first frame alone `once` and once_barriers,
/// opening_observations, then `steps`; a step is its barriers, its pass, its observations.
///
/// A pass's first command may be a clear (transfer) although its port declares another access; the barriers here reach
/// the declared access's stages, so the one who records the clear chains from those stages to the transfer.
struct Plan {
  Graph graph;
  std::vector<Clear> prologue;             ///< constants, rings, persistent values
  std::vector<Barrier> prologue_barriers;  ///< after the clears
  std::vector<PlanStep> once;              ///< passes that give the same in every frame (GraphPass::once)
  std::vector<Barrier> once_barriers;      ///< after them, for those that only the frame's steps and observers read
  std::vector<Barrier> frame_start;        ///< last frame's reads of frame inputs before this frame's upload
  std::vector<Barrier> inputs_ready;       ///< upload before the reads
  std::vector<Observation> opening_observations;  ///< of values that `steps` do not produce: constants, those of `once`
  std::vector<PlanStep> steps;                    ///< what every frame runs
};

/// How the plan keeps one access from meeting another.
enum class SyncPolicy : uint8_t {
  minimal,       ///< only the barriers that the accesses demand
  conservative,  ///< everything before a step or an observation is done before it begins
};
[[nodiscard]] std::string_view to_string(SyncPolicy policy);  ///< as on the command line

/// Choices that change how a graph is executed but never what it computes.
struct CompileOptions {
  SyncPolicy sync = SyncPolicy::minimal;
  PassOrder order = PassOrder::level;
  uint64_t order_seed = 0;  ///< of PassOrder::random
  bool scan = false;        ///< every value that a pass writes is scanned right behind it
};

/// Orders and synchronises. Pure; the same graph and options give the same plan.
[[nodiscard]] Plan compile(const Graph& graph, const CompileOptions& options = {});

/// Readable text: what runs once and why, what each frame runs in order, params, inputs with ages, outputs with shapes
/// and bytes, barriers with reasons, what was culled and bypassed, memory and rings.
[[nodiscard]] std::string print_plan(const Plan& plan);

/// Hash of what is executed: steps, once or each frame, params, values, uses, barriers, observations. What was culled
/// or bypassed, remarks and positions in the file do not count, so a disabled node hashes as if it had never been
/// written.
[[nodiscard]] uint64_t plan_hash(const Plan& plan);

struct MemoryUse {
  uint64_t total = 0;  ///< all images with their rings [bytes]
  uint64_t rings = 0;  ///< the part of it in rings of more than one layer [bytes]
};
[[nodiscard]] MemoryUse memory_use(const Graph& graph);

}  // namespace lightloom
