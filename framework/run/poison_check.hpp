#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "framework/run/frame_ranges.hpp"
#include "framework/run/scanned_value.hpp"
#include "framework/run/value_marks.hpp"

namespace lightloom::run {

/// A value that depends on what nobody wrote, although nothing that its pass read does.
struct Unwritten {
  std::string pass;
  ValueId id = 0;
  std::string value;  ///< "pass.port[.part]"
  ImageDesc desc;
  uint32_t texels = 0;  ///< that its pass left as they were; 0: it wrote all, out of what nobody wrote
  uint32_t first = 0;   ///< of them
  FrameRanges frames;   ///< `texels` and `first` are of the first of them
};

/// Names the passes that read what nobody wrote, or leave it where others read: compares two runs of one plan that
/// differ in their poison alone (PoisonTone), value by value, by what their scans found. Also a pass whose bits differ
/// from run to run for another reason is named, as one that read what nobody wrote.
class PoisonCheck {
 public:
  explicit PoisonCheck(const Plan& plan) : plan_(plan), marks_(plan) {}

  /// Compares one frame of both runs; frames come in order.
  void add(uint32_t frame, std::span<const ScannedValue> nan_run, std::span<const ScannedValue> number_run);

  /// In the order in which they were first seen: by frame, then as executed.
  [[nodiscard]] const std::vector<Unwritten>& found() const { return found_; }
  /// A sentence each.
  [[nodiscard]] std::vector<std::string> complaints() const;
  [[nodiscard]] nlohmann::ordered_json record() const;

 private:
  void name(uint32_t frame, const GraphPass& pass, const ScannedValue& nan_run, const ScannedValue& number_run);

  const Plan& plan_;
  ValueMarks marks_;
  std::vector<Unwritten> found_;
};

}  // namespace lightloom::run
