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

  FrameRanges() = default;
  /// What `json` made.
  explicit FrameRanges(const nlohmann::ordered_json& pairs) {
    for (const nlohmann::ordered_json& pair : pairs)
      ranges_.push_back({pair.at(0).get<uint32_t>(), pair.at(1).get<uint32_t>()});
  }

  /// In ascending order.
  void add(uint32_t frame) {
    if (ranges_.empty() || ranges_.back().last + 1 != frame)
      ranges_.push_back({frame, frame});
    else
      ranges_.back().last = frame;
  }
  [[nodiscard]] const std::vector<Range>& ranges() const { return ranges_; }
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (const Range& range : ranges_)
      for (uint32_t frame = range.first;; ++frame) {
        visit(frame);
        if (frame == range.last) break;
      }
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
