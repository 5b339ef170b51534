#pragma once

#include <deque>
#include <vector>

#include "framework/graph/plan.hpp"

namespace lightloom::run {

/// Marks on this frame's values and on those of earlier frames that are still read, for observers that tell who was
/// first. What runs once keeps its mark.
class ValueMarks {
 public:
  explicit ValueMarks(const Plan& plan);

  /// What was this frame's becomes the last frame's.
  void begin_frame();
  void mark(ValueId value, uint32_t age = 0);
  [[nodiscard]] bool marked(ValueId value, uint32_t age = 0) const;
  /// Does the pass read a marked value, also one that it left to itself (a persistent one)?
  [[nodiscard]] bool reads_marked(const GraphPass& pass) const;
  [[nodiscard]] std::vector<ValueId> marked_now() const;  ///< of this frame, ascending

 private:
  const Graph& graph_;
  std::vector<std::deque<bool>> marks_;  ///< by value and age
  std::vector<bool> every_frame_;        ///< by value: written in every frame
};

}  // namespace lightloom::run
