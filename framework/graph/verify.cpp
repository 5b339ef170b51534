#include "framework/graph/verify.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "framework/graph/verify_trace.hpp"

namespace lightloom {
namespace {

using verification::Event;
using verification::kPrologue;
using verification::kUndefined;
using verification::Piece;
using verification::Trace;

bool within(uint64_t part, uint64_t whole) {
  return (part & ~whole) == 0;
}

/// Access bits that write; the others only read.
constexpr VkAccessFlags2 kWriteBits = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                                      VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

/// All stages and accesses that a table row stands for: the host is no command.
AccessInfo spelled_out(Access access) {
  AccessInfo info = access_info(access);
  if ((info.stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0) info.stages = ~VK_PIPELINE_STAGE_2_HOST_BIT;
  constexpr VkAccessFlags2 kHost = VK_ACCESS_2_HOST_READ_BIT | VK_ACCESS_2_HOST_WRITE_BIT;
  if ((info.access & VK_ACCESS_2_MEMORY_WRITE_BIT) != 0) info.access = ~kHost;
  return info;
}

/// How far one access has come by the barriers after it.
class Reach {
 public:
  explicit Reach(const AccessInfo& source) : source_(source) {}

  /// Barriers recorded together: none of them carries on what another one brings.
  void pass(std::span<const Event> batch) {
    const VkPipelineStageFlags2 stages_before = stages_;
    const bool available_before = available_;
    for (const Event& event : batch) {
      const AccessInfo from = spelled_out(event.from);
      const AccessInfo to = spelled_out(event.access);
      const bool direct = within(source_.stages, from.stages);
      if (!direct && (stages_before & from.stages) == 0) continue;
      stages_ |= to.stages;
      const bool makes_available = direct && within(source_.access & kWriteBits, from.access);
      available_ = available_ || makes_available;
      if (available_before || makes_available) visible_.emplace_back(to.stages, to.access);
    }
  }

  /// Is the access done, and its writes available, when something begins that waits for `stages` and `access`?
  [[nodiscard]] bool ends_before(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const {
    const bool direct = within(source_.stages, stages);
    if (!direct && (stages_ & stages) == 0) return false;
    return !source_.writes || available_ || (direct && within(source_.access & kWriteBits, access));
  }

  [[nodiscard]] bool covers(const AccessInfo& target) const {
    if (!within(target.stages, stages_)) return false;
    if (!source_.writes) return true;
    return std::any_of(visible_.begin(), visible_.end(), [&](const auto& scope) {
      return within(target.stages, scope.first) && within(target.access, scope.second);
    });
  }

 private:
  const AccessInfo& source_;
  VkPipelineStageFlags2 stages_ = 0;
  bool available_ = false;
  std::vector<std::pair<VkPipelineStageFlags2, VkAccessFlags2>> visible_;
};

class Judge {
 public:
  Judge(const Plan& plan, std::size_t limit, Verification& result) : plan_(plan), limit_(limit), result_(result) {}

  void check(const Trace& trace) {
    contents(trace);
    std::set<Access> reads;  // since the last barrier or write
    for (std::size_t i = 0; i < trace.size() && !full(); ++i) {
      const bool read = trace[i].kind == Event::Kind::access && !access_info(trace[i].access).writes;
      if (!read) reads.clear();
      if (trace[i].kind == Event::Kind::takeover) begins(trace, i);
      if (trace[i].kind != Event::Kind::access) continue;
      // Alike reads with no barrier between them reach alike far.
      if (!read || reads.insert(trace[i].access).second) order(trace, i);
    }
  }

 private:
  [[nodiscard]] bool full() const { return result_.violations.size() >= limit_; }

  [[nodiscard]] std::string name(ValueId value) const {
    return value == kFrameInputs ? "frame inputs" : value_name(plan_.graph.values[value]);
  }

  void complain(ValueId value, const std::string& sentence) {
    const std::string text = name(value) + ": " + sentence;
    const auto& known = result_.violations;
    if (!full() && std::find(known.begin(), known.end(), text) == known.end()) result_.violations.push_back(text);
  }

  static std::string phrase(const Event& access) {
    return std::string(access.who) + " (" + std::string(access_info(access.access).name) + ")";
  }

  static std::string frame_text(int frame) {
    if (frame == kUndefined) return "what is undefined";
    return frame == kPrologue ? "the clear" : "what frame " + std::to_string(frame) + " wrote";
  }

  /// Follows what the piece holds.
  void contents(const Trace& trace) {
    constexpr ValueId kNobody = kEverything;
    ValueId holder = kNobody;
    int content = kUndefined;
    for (const Event& event : trace) {
      if (full()) return;
      if (event.kind == Event::Kind::barrier) continue;
      if (event.kind == Event::Kind::takeover) {
        holder = event.value;
        content = kUndefined;
        continue;
      }
      const bool writes = access_info(event.access).writes;
      if (holder != event.value && holder != kNobody) {
        complain(event.value,
                 std::string(event.who) + " touches memory that holds " + name(holder) + " and was not taken over");
        return;
      }
      const bool expects = !writes || event.content != kUndefined;
      if (expects && event.frame != kPrologue && content != event.content)
        complain(event.value,
                 std::string(event.who) + " finds " + frame_text(content) + " instead of " + frame_text(event.content));
      holder = event.value;
      if (writes) content = event.frame;
    }
  }

  /// Holds later accesses that conflict with the one at `first` against the barriers between, up to the first write
  /// that is in order: whatever conflicts with the former behind it conflicts with the latter too, and a chain of
  /// barriers that begins at the latter goes on from the former.
  void order(const Trace& trace, std::size_t first) {
    const AccessInfo& source = access_info(trace[first].access);
    Reach reach(source);
    for (std::size_t i = first + 1; i < trace.size(); ++i) {
      const Event& event = trace[i];
      if (event.kind != Event::Kind::access) {
        const std::span<const Event> batch = batch_from(trace, i);
        if (!taken_over(trace, first, batch, reach)) return;
        reach.pass(batch);
        i += batch.size() - 1;
        continue;
      }
      const AccessInfo& target = access_info(event.access);
      if (!source.writes && !target.writes) continue;
      ++result_.pairs;
      if (!reach.covers(target))
        complain(event.value, phrase(trace[first]) + " and " + phrase(event) + " are not ordered" +
                                  (event.frame != trace[first].frame ? " from frame to frame" : ""));
      if (target.writes || !reach.covers(target)) return;
    }
  }

  static std::span<const Event> batch_from(const Trace& trace, std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < trace.size() && trace[end].kind != Event::Kind::access && trace[end].batch == trace[begin].batch)
      ++end;
    return std::span(trace).subspan(begin, end - begin);
  }

  /// Its first access must wait for the change of layout, by one of the takeovers recorded together.
  void begins(const Trace& trace, std::size_t at) {
    for (std::size_t i = at + 1; i < trace.size(); ++i) {
      if (trace[i].kind != Event::Kind::access) continue;
      const AccessInfo& target = access_info(trace[i].access);
      const AccessInfo& reached = access_info(trace[at].access);
      if (!within(target.stages, reached.stages) || !within(target.access, reached.access))
        complain(trace[i].value, std::string(trace[i].who) + " does not wait for the memory to be taken over");
      return;
    }
  }

  /// The change of layout writes, behind all that the takeovers of its value in this batch wait for.
  bool taken_over(const Trace& trace, std::size_t first, std::span<const Event> batch, const Reach& reach) {
    for (const Event& taker : batch) {
      if (taker.kind != Event::Kind::takeover) continue;
      VkPipelineStageFlags2 stages = 0;
      VkAccessFlags2 access = 0;
      for (const Event& event : batch) {
        if (event.kind != Event::Kind::takeover || event.value != taker.value) continue;
        stages |= access_info(event.from).stages;
        access |= access_info(event.from).access;
      }
      if (reach.ends_before(stages, access)) continue;
      complain(taker.value,
               "takes memory over before " + phrase(trace[first]) + " is done with " + name(trace[first].value));
      return false;
    }
    return true;
  }

  const Plan& plan_;
  std::size_t limit_;
  Verification& result_;
};

}  // namespace

Verification verify(const Plan& plan, const PlannedMemory& memory, std::size_t limit) {
  Verification result;
  const std::map<Piece, Trace> traces = verification::play(plan, memory, result);
  Judge judge(plan, limit, result);
  for (const auto& [piece, trace] : traces) judge.check(trace);
  return result;
}

}  // namespace lightloom
