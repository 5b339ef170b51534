#include "framework/graph/schedule.hpp"

#include <algorithm>
#include <functional>
#include <queue>

namespace lightloom {
namespace {

/// Who reads this frame's values of whom, by pass; one entry a use.
struct Dependencies {
  std::vector<std::vector<uint32_t>> consumers;
  std::vector<uint32_t> open_sources;  ///< uses whose producer has not run
};

Dependencies dependencies_of(const Graph& graph) {
  const auto count = static_cast<uint32_t>(graph.passes.size());
  std::vector<uint32_t> producer(graph.values.size(), count);
  for (uint32_t i = 0; i < count; ++i)
    for (const Use& use : graph.passes[i].outputs) producer[use.value] = i;
  Dependencies result{std::vector<std::vector<uint32_t>>(count), std::vector<uint32_t>(count)};
  for (uint32_t i = 0; i < count; ++i) {
    for (const Use& use : graph.passes[i].inputs) {
      if (use.first_age > 0 || producer[use.value] == count) continue;
      result.consumers[producer[use.value]].push_back(i);
      ++result.open_sources[i];
    }
  }
  return result;
}

/// Runs passes whose sources have run: which of them next, `Ready` decides by push, pop and empty.
template <class Ready>
Schedule run(Dependencies dependencies, Ready ready) {
  const auto count = static_cast<uint32_t>(dependencies.consumers.size());
  Schedule result;
  result.levels.assign(count, 0);
  for (uint32_t i = 0; i < count; ++i)
    if (dependencies.open_sources[i] == 0) ready.push(i);
  while (!ready.empty()) {
    const uint32_t pass = ready.pop();
    result.order.push_back(pass);
    for (const uint32_t consumer : dependencies.consumers[pass]) {
      result.levels[consumer] = std::max(result.levels[consumer], result.levels[pass] + 1);
      if (--dependencies.open_sources[consumer] == 0) ready.push(consumer);
    }
  }
  return result;
}

/// The first declared of those that are ready.
class FirstDeclared {
 public:
  void push(uint32_t pass) { passes_.push(pass); }
  uint32_t pop() {
    const uint32_t first = passes_.top();
    passes_.pop();
    return first;
  }
  [[nodiscard]] bool empty() const { return passes_.empty(); }

 private:
  std::priority_queue<uint32_t, std::vector<uint32_t>, std::greater<>> passes_;
};

/// Any of those that are ready, by SplitMix64 (Steele, Lea and Flood 2014).
class AnyReady {
 public:
  explicit AnyReady(uint64_t seed) : state_(seed) {}
  void push(uint32_t pass) { passes_.push_back(pass); }
  uint32_t pop() {
    std::swap(passes_[draw() % passes_.size()], passes_.back());
    const uint32_t pass = passes_.back();
    passes_.pop_back();
    return pass;
  }
  [[nodiscard]] bool empty() const { return passes_.empty(); }

 private:
  uint64_t draw() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }

  std::vector<uint32_t> passes_;
  uint64_t state_;
};

}  // namespace

std::string to_string(PassOrder order, uint64_t seed) {
  if (order == PassOrder::random) return "random:" + std::to_string(seed);
  return order == PassOrder::declared ? "declared" : "level";
}

Schedule schedule(const Graph& graph, PassOrder order, uint64_t seed) {
  if (order == PassOrder::random) return run(dependencies_of(graph), AnyReady(seed));
  Schedule result = run(dependencies_of(graph), FirstDeclared());
  if (order == PassOrder::declared) return result;
  std::sort(result.order.begin(), result.order.end(), [&](uint32_t a, uint32_t b) {
    return result.levels[a] != result.levels[b] ? result.levels[a] < result.levels[b] : a < b;
  });
  return result;
}

}  // namespace lightloom
