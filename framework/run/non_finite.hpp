#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "framework/run/executor_state.hpp"
#include "framework/run/frame_ranges.hpp"
#include "framework/run/scanned_value.hpp"
#include "framework/run/value_marks.hpp"

namespace lightloom::run {

/// A value that held NaN or infinity although all that its pass read was finite.
struct NonFinite {
  std::string pass;
  std::string value;  ///< "pass.port[.part]"
  ScannedValue seen;  ///< in the first of `frames`
  FrameRanges frames;
  ImageDesc desc;
  std::vector<std::string> inputs;  ///< what the pass read: values, with "@age" those of earlier frames
};

/// Names the passes that made NaN or infinity of finite values, from what the scans found (Plan, Observer::scan).
class NonFiniteWatch {
 public:
  explicit NonFiniteWatch(const Plan& plan);

  /// Takes over what a resumed run starts from, before its first frame.
  void resume(const ExecutorState& state);
  /// Looks through one frame; frames come in order.
  void add(uint32_t frame, std::span<const ScannedValue> scanned);

  /// In the order in which they were first seen: by frame, then as executed.
  [[nodiscard]] const std::vector<NonFinite>& found() const { return found_; }
  /// A sentence each.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// {"made": [...], "passed_on": [names of values that had it from others]}
  [[nodiscard]] nlohmann::ordered_json record() const;

 private:
  void look_at(uint32_t frame, const GraphPass& pass, std::span<const ScannedValue> scanned);
  void name(uint32_t frame, const GraphPass& pass, const ScannedValue& seen);

  const Plan& plan_;
  ValueMarks marks_;
  std::vector<NonFinite> found_;
  std::set<std::string> passed_on_;
};

}  // namespace lightloom::run
