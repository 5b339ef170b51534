#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace lightloom::study {

/// How long work of a kind takes, learnt from what is done. A kind is a row of a study.
class TimeEstimate {
 public:
  void add(size_t kind, double seconds);
  /// Mean of that kind; of all kinds where it was never done; empty where nothing was.
  [[nodiscard]] std::optional<double> of(size_t kind) const;
  /// Of all these, so many at a time.
  [[nodiscard]] std::optional<double> left(const std::vector<size_t>& kinds, size_t at_a_time) const;

 private:
  struct Sum {
    double seconds = 0;
    size_t count = 0;
  };
  std::map<size_t, Sum> kinds_;
};

}  // namespace lightloom::study
