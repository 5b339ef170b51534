#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lightloom::run {

/// Frames in which something was seen, as ranges.
class FrameRanges {
 public:
  struct Range {
    uint32_t first = 0;
    uint32_t last = 0;  ///< included
  };

  /// In ascending order.
  void add(uint32_t frame) {
    if (ranges_.empty() || ranges_.back().last + 1 != frame)
      ranges_.push_back({frame, frame});
    else
      ranges_.back().last = frame;
  }
  /// "frame 3", "frames 3..7", "frames 3, 5..9"
  [[nodiscard]] std::string text() const {
    const bool one = ranges_.size() == 1 && ranges_.front().first == ranges_.front().last;
    std::string words = one ? "frame " : "frames ";
    for (size_t i = 0; i < ranges_.size(); ++i) {
      const Range& range = ranges_[i];
      words += (i > 0 ? ", " : "") + std::to_string(range.first);
      if (range.last > range.first) words += ".." + std::to_string(range.last);
    }
    return words;
  }
  [[nodiscard]] nlohmann::ordered_json json() const {  ///< [[first, last], ...]
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    for (const Range& range : ranges_) pairs.push_back({range.first, range.last});
    return pairs;
  }

 private:
  std::vector<Range> ranges_;
};

}  // namespace lightloom::run
