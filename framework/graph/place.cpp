#include "framework/graph/place.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace lightloom {
namespace {

using Order = std::vector<uint32_t>;

constexpr size_t kExactBlocks = 8;
constexpr size_t kImprovements = 64;
constexpr size_t kEffort = 20'000;  ///< blocks to be placed by all tries from one order, where that allows two tries

uint64_t aligned(uint64_t offset, uint64_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

/// Puts blocks one after another to the lowest offset that is free of those already there.
class Stack {
 public:
  explicit Stack(std::span<const Block> blocks) : blocks_(blocks), offsets_(blocks.size()) {
    uint32_t end = 0;
    for (const Block& block : blocks) end = std::max(end, block.last + 1);
    begun_.resize(end);
    running_.resize(end);
  }

  uint64_t put(uint32_t index) {
    const Block& block = blocks_[index];
    collect_taken(block);
    uint64_t offset = 0;
    for (const auto& [begin, end] : taken_) {
      if (offset + block.size <= begin) break;
      offset = std::max(offset, aligned(end, block.alignment));
    }
    offsets_[index] = offset;
    placed_.push_back(index);
    begun_[block.first].push_back(index);
    for (uint32_t step = block.first + 1; step <= block.last; ++step) running_[step].push_back(index);
    return offset + block.size;
  }
  void take_back() {
    const Block& block = blocks_[placed_.back()];
    placed_.pop_back();
    begun_[block.first].pop_back();
    for (uint32_t step = block.first + 1; step <= block.last; ++step) running_[step].pop_back();
  }
  [[nodiscard]] const std::vector<uint64_t>& offsets() const { return offsets_; }

 private:
  /// The ranges of those who are live together with the block, in order.
  void collect_taken(const Block& block) {
    taken_.clear();
    const auto take = [&](const std::vector<uint32_t>& others) {
      for (const uint32_t other : others) taken_.emplace_back(offsets_[other], offsets_[other] + blocks_[other].size);
    };
    take(running_[block.first]);
    for (uint32_t step = block.first; step <= block.last; ++step) take(begun_[step]);
    std::sort(taken_.begin(), taken_.end());
  }

  std::span<const Block> blocks_;
  std::vector<uint64_t> offsets_;
  std::vector<uint32_t> placed_;
  std::vector<std::vector<uint32_t>> begun_;    ///< by step: placed blocks whose first it is …
  std::vector<std::vector<uint32_t>> running_;  ///< … and those that began before it and are live in it
  std::vector<std::pair<uint64_t, uint64_t>> taken_;
};

uint64_t lower_bound_of(std::span<const Block> blocks) {
  std::map<uint32_t, uint64_t> changes;  // by step; what ends is added modulo 2^64
  for (const Block& block : blocks) {
    changes[block.first] += block.size;
    changes[block.last + 1] -= block.size;
  }
  uint64_t sum = 0;
  uint64_t bound = 0;
  for (const auto& [step, change] : changes) {
    sum += change;
    bound = std::max(bound, sum);
  }
  return bound;
}

class Search {
 public:
  explicit Search(std::span<const Block> blocks) : blocks_(blocks) {
    best_.lower_bound = lower_bound_of(blocks);
    best_.heap = std::numeric_limits<uint64_t>::max();
  }

  Placement run() {
    Order order;
    for (uint32_t i = 0; i < blocks_.size(); ++i)
      if (blocks_[i].size > 0) order.push_back(i);
    best_.offsets.assign(blocks_.size(), 0);
    if (order.empty()) return {best_.offsets, 0, 0};
    for (const auto& before : orders()) {
      std::stable_sort(order.begin(), order.end(),
                       [&](uint32_t a, uint32_t b) { return before(blocks_[a], blocks_[b]); });
      improve(order);
      if (done()) return best_;
    }
    if (order.size() <= kExactBlocks) exhaust(order);
    return best_;
  }

 private:
  using Before = std::function<bool(const Block&, const Block&)>;

  static std::vector<Before> orders() {
    const auto span = [](const Block& block) { return uint64_t{block.last} - block.first + 1; };
    return {[](const Block& a, const Block& b) { return a.size > b.size; },
            [=](const Block& a, const Block& b) { return span(a) > span(b); },
            [=](const Block& a, const Block& b) {
              return static_cast<double>(a.size) * static_cast<double>(span(a)) >
                     static_cast<double>(b.size) * static_cast<double>(span(b));
            },
            [](const Block& a, const Block& b) { return a.first < b.first; },
            [](const Block& a, const Block& b) { return a.last > b.last; }};
  }

  [[nodiscard]] bool done() const { return best_.heap == best_.lower_bound; }

  struct Attempt {
    uint64_t heap = 0;
    size_t top = 0;  ///< place in the order of the block that ends highest
  };

  Attempt try_order(const Order& order) {
    Stack stack(blocks_);
    Attempt attempt;
    for (size_t i = 0; i < order.size(); ++i) {
      const uint64_t end = stack.put(order[i]);
      if (end > attempt.heap) attempt = {end, i};
    }
    if (attempt.heap < best_.heap) {
      best_.heap = attempt.heap;
      best_.offsets = stack.offsets();
    }
    return attempt;
  }

  /// What sticks out at the top goes first in the next try.
  void improve(Order order) {
    const size_t rounds = std::clamp<size_t>(kEffort / order.size(), 2, kImprovements);
    for (size_t round = 0; round < rounds && !done(); ++round) {
      const size_t top = try_order(order).top;
      if (top == 0) return;
      const auto block = order.begin() + static_cast<std::ptrdiff_t>(top);
      std::rotate(order.begin(), block, block + 1);
    }
  }

  void exhaust(Order& order) {
    Stack stack(blocks_);
    const std::function<void(size_t, uint64_t)> choose = [&](size_t depth, uint64_t heap) {
      if (heap >= best_.heap || done()) return;
      if (depth == order.size()) {
        best_.heap = heap;
        best_.offsets = stack.offsets();
        return;
      }
      for (size_t next = depth; next < order.size(); ++next) {
        std::swap(order[depth], order[next]);
        const uint64_t end = stack.put(order[depth]);
        choose(depth + 1, std::max(heap, end));
        stack.take_back();
        std::swap(order[depth], order[next]);
      }
    };
    choose(0, 0);
  }

  std::span<const Block> blocks_;
  Placement best_;
};

}  // namespace

Placement place(std::span<const Block> blocks) {
  return Search(blocks).run();
}

}  // namespace lightloom
